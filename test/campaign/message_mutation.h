// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <boost/array.hpp>

#include <ros/duration.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/time.h>

namespace datmo::campaign {

/// Number of elements of a long list that are mutated: the first ones are as good as any.
constexpr std::size_t kMaxElements = 8;

/// Visits the fields of a message of any type, as ROS's serialization lists them, and corrupts the
/// selected ones: NaN, infinite or out-of-range numbers, lists of other lengths, other names,
/// stamps far off. The message can still be sent.
class FieldSpoiler {
 public:
  /// `turns`: indices of the fields to corrupt, in the order in which they are visited; empty: only
  /// counts them.
  FieldSpoiler(std::mt19937& random, std::vector<std::size_t> turns)
      : random_(random), turns_(std::move(turns)) {}

  std::size_t fields() const { return fields_; }

  /// Called by ROS's serializers for each field.
  template <typename Field>
  void next(Field& field) {
    if constexpr (ros::message_traits::IsMessage<Field>::value) {
      ros::serialization::Serializer<Field>::read(*this, field);
    } else if (isTurn()) {
      spoil(field);
    }
  }

  template <typename Element, typename Allocator>
  void next(std::vector<Element, Allocator>& elements) {
    if (isTurn()) {
      elements.resize(lengthInsteadOf(elements.size()));
    }
    for (std::size_t i = 0; i < std::min(elements.size(), kMaxElements); ++i) {
      next(elements[i]);
    }
  }

  template <typename Element, std::size_t count>
  void next(boost::array<Element, count>& elements) {
    for (std::size_t i = 0; i < std::min(count, kMaxElements); ++i) {
      next(elements[i]);
    }
  }

 private:
  bool isTurn() { return std::count(turns_.begin(), turns_.end(), fields_++) > 0; }

  template <typename Choices>
  auto oneOf(const Choices& choices) {
    return choices[random_() % choices.size()];
  }

  std::size_t lengthInsteadOf(std::size_t length) {
    return oneOf(std::array<std::size_t, 6>{0, 1, length / 2, length + 1, 2 * length, 5000});
  }

  template <typename Number>
  std::enable_if_t<std::is_floating_point_v<Number>> spoil(Number& number) {
    using Limits = std::numeric_limits<Number>;
    number = oneOf(std::array<Number, 14>{
        Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), Limits::max(), -Limits::max(),
        Limits::denorm_min(), Number(0), Number(-0.0), -number, number * Number(1e3),
        number + Number(1), Number(1e-9), Number(1e9), Number(-1)});
  }

  template <typename Number>
  std::enable_if_t<std::is_integral_v<Number>> spoil(Number& number) {
    using Limits = std::numeric_limits<Number>;
    number = oneOf(std::array<Number, 6>{0, 1, Limits::max(), Limits::min(),
                                         static_cast<Number>(number + 1),
                                         static_cast<Number>(random_())});
  }

  void spoil(std::string& text) {
    text = oneOf(std::array<std::string, 8>{"", "/", "/" + text, "base_link", "map", "a b/c\n",
                                            std::string(4000, 'x'), text + "2"});
  }

  void spoil(ros::Time& time) {
    const double offset =
        oneOf(std::array<double, 9>{1.0, -1.0, 1.5, -1.5, 1e6, -10.0, 0.3, -0.3, 0.0});
    if (offset == 0.0) {
      time = oneOf(std::array<ros::Time, 3>{ros::Time(), ros::TIME_MAX, ros::Time(1, 0)});
    } else {
      time = ros::Time(std::max(0.0, std::min(time.toSec() + offset, 4e9)));
    }
  }

  void spoil(ros::Duration& duration) {
    duration = oneOf(std::array<ros::Duration, 4>{ros::Duration(), ros::DURATION_MAX,
                                                  ros::DURATION_MIN, ros::Duration(1e6)});
  }

  std::mt19937& random_;
  std::vector<std::size_t> turns_;
  std::size_t fields_ = 0;
};

/// Visits the fields of a message of any type and moves its time stamps.
class StampShift {
 public:
  explicit StampShift(ros::Duration shift) : shift_(shift) {}

  /// Called by ROS's serializers for each field.
  template <typename Field>
  void next(Field& field) {
    if constexpr (ros::message_traits::IsMessage<Field>::value) {
      ros::serialization::Serializer<Field>::read(*this, field);
    } else if constexpr (std::is_same_v<Field, ros::Time>) {
      field = field.isZero() ? field : field + shift_;
    }
  }

  template <typename Element, typename Allocator>
  void next(std::vector<Element, Allocator>& elements) {
    if constexpr (ros::message_traits::IsMessage<Element>::value) {
      std::for_each(elements.begin(), elements.end(), [this](Element& element) { next(element); });
    }
  }

  template <typename Element, std::size_t count>
  void next(boost::array<Element, count>& elements) {
    std::for_each(elements.begin(), elements.end(), [this](Element& element) { next(element); });
  }

 private:
  ros::Duration shift_;
};

/// Returns a copy of a message with all its time stamps, but for unset ones, moved by `shift`.
template <typename Message>
Message shifted(Message message, ros::Duration shift) {
  StampShift visitor(shift);
  ros::serialization::Serializer<Message>::read(visitor, message);
  return message;
}

/// Returns a copy of a message with one to three of its fields corrupted.
template <typename Message>
Message mutated(Message message, std::mt19937& random) {
  FieldSpoiler counter(random, {});
  ros::serialization::Serializer<Message>::read(counter, message);
  std::vector<std::size_t> turns(1 + random() % 3);
  std::generate(turns.begin(), turns.end(), [&] { return random() % counter.fields(); });
  FieldSpoiler spoiler(random, turns);
  ros::serialization::Serializer<Message>::read(spoiler, message);
  return message;
}

}  // namespace datmo::campaign
