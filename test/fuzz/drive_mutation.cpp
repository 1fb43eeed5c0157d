// SPDX-License-Identifier: BSD-3-Clause
#include "drive_mutation.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include "message_kinds.h"

#include <ros/duration.h>

namespace datmo::fuzz {

namespace {

using campaign::MessageKind;
using campaign::messageKinds;

constexpr std::size_t kMaxChanges = 4;   // to one drive
constexpr std::size_t kMoreBytes = 256;  // by which a message may grow
constexpr std::size_t kMaxBetween = 3;   // messages between one and its copy

std::size_t below(std::size_t count, std::mt19937& random) { return random() % count; }

/// A drive, and the message that is to be changed in it.
struct Spot {
  FuzzedDrive& drive;
  std::size_t index;
  double period;  ///< s
  const MutateBytes& mutate_bytes;
  std::mt19937& random;

  TimedMessage& message() const { return drive.messages[index]; }
  std::vector<TimedMessage>::iterator at() const {
    return drive.messages.begin() + static_cast<std::ptrdiff_t>(index);
  }
};

/// Calls `change` with a decoded message; its bytes remain if they are no message.
template <typename Change>
void changeContent(const FuzzedDrive& drive, TimedMessage& message, const Change& change) {
  const auto kind = messageKinds().find(drive.topicOf(message).data_type);
  if (kind == messageKinds().end()) {
    return;
  }
  try {
    message.bytes = kind->second.encoded(change(kind->second, kind->second.decoded(message.bytes)));
  } catch (const std::exception&) {  // was made undecodable before
  }
}

void spoilFieldsOf(const FuzzedDrive& drive, TimedMessage& message, std::mt19937& random) {
  changeContent(drive, message, [&](const MessageKind& kind, const AnyMessage& content) {
    return kind.mutated(content, random);
  });
}

void spoilFields(const Spot& spot) { spoilFieldsOf(spot.drive, spot.message(), spot.random); }

/// Replaces a number somewhere in the bytes: of long lists, spoilFields() reaches only the
/// beginning.
template <typename Number>
void spoilNumber(const Spot& spot) {
  std::vector<std::uint8_t>& bytes = spot.message().bytes;
  if (bytes.size() < sizeof(Number)) {
    return;
  }
  std::uint8_t* const at = bytes.data() + below(bytes.size() - sizeof(Number) + 1, spot.random);
  Number number = 0;
  std::memcpy(&number, at, sizeof(Number));
  using Limits = std::numeric_limits<Number>;
  const std::array<Number, 10> numbers{Limits::quiet_NaN(),
                                       Limits::infinity(),
                                       -Limits::infinity(),
                                       Limits::max(),
                                       Limits::denorm_min(),
                                       Number(0),
                                       -number,
                                       number * Number(1e3),
                                       Number(-1),
                                       Number(1e9)};
  number = numbers[below(numbers.size(), spot.random)];
  std::memcpy(at, &number, sizeof(Number));
}

void spoilBytes(const Spot& spot) {
  std::vector<std::uint8_t>& bytes = spot.message().bytes;
  spot.mutate_bytes(bytes, bytes.size() + kMoreBytes);
}

/// Inserts a copy with later stamps, as if this sensor or stage sent at a higher rate.
void insertCopy(const Spot& spot) {
  const ros::Duration shift(std::uniform_real_distribution<double>(0.0, spot.period)(spot.random));
  TimedMessage copy = spot.message();
  changeContent(spot.drive, copy, [&](const MessageKind& kind, const AnyMessage& content) {
    return kind.shifted(content, shift);
  });
  copy.wait = 0;
  spoilFieldsOf(spot.drive, copy, spot.random);
  const std::size_t between =
      std::min(below(kMaxBetween + 1, spot.random), spot.drive.messages.size() - spot.index - 1);
  spot.drive.messages.insert(std::next(spot.at(), 1 + static_cast<std::ptrdiff_t>(between)),
                             std::move(copy));
}

void loseMessage(const Spot& spot) { spot.drive.messages.erase(spot.at()); }

void swapMessages(const Spot& spot) {
  auto& messages = spot.drive.messages;
  std::swap(spot.message(), messages[below(messages.size(), spot.random)]);
}

/// A sensor is silent from here on.
void silenceTopic(const Spot& spot) {
  auto& messages = spot.drive.messages;
  messages.erase(std::remove_if(spot.at(), messages.end(),
                                [topic = spot.message().topic](const TimedMessage& message) {
                                  return message.topic == topic;
                                }),
                 messages.end());
}

void repeatMessage(const Spot& spot) {
  TimedMessage copy = spot.message();
  spot.drive.messages.insert(spot.at(), std::move(copy));
}

void changeWait(const Spot& spot) {
  constexpr std::array<std::uint16_t, 6> kWaits{0, 1, 30, 600, 1500, 60000};  // ms
  spot.message().wait = kWaits[below(kWaits.size(), spot.random)];
}

/// Moves the message to another topic of its type.
void changeTopic(const Spot& spot) {
  const std::vector<TypedTopic>& topics = spot.drive.topics;
  const std::string& type = spot.drive.topicOf(spot.message()).data_type;
  const std::size_t first = below(topics.size(), spot.random);
  for (std::size_t i = 0; i < topics.size(); ++i) {
    const std::size_t topic = (first + i) % topics.size();
    if (topics[topic].data_type == type) {
      spot.message().topic = static_cast<std::uint8_t>(topic);
      return;
    }
  }
}

void changeGraph(const Spot& spot) { spot.drive.graph = static_cast<std::uint8_t>(spot.random()); }

struct WeightedChange {
  double weight;  ///< share of the changes: of their sum
  void (*change)(const Spot& spot);
};

/// Mostly fields: such messages are still decoded, and reach the stages.
constexpr std::array<WeightedChange, 12> kChanges{{{8.0, spoilFields},
                                                   {2.0, spoilNumber<float>},
                                                   {1.0, spoilNumber<double>},
                                                   {2.0, spoilBytes},
                                                   {3.0, insertCopy},
                                                   {0.25, loseMessage},
                                                   {0.25, swapMessages},
                                                   {0.25, silenceTopic},
                                                   {0.25, repeatMessage},
                                                   {1.0, changeWait},
                                                   {1.0, changeTopic},
                                                   {1.0, changeGraph}}};

const WeightedChange& drawnChange(std::mt19937& random) {
  static const std::vector<double> weights = [] {
    std::vector<double> all;
    for (const WeightedChange& change : kChanges) {
      all.push_back(change.weight);
    }
    return all;
  }();
  return kChanges[std::discrete_distribution<std::size_t>(weights.begin(), weights.end())(random)];
}

}  // namespace

void mutate(FuzzedDrive& drive, double period, const MutateBytes& mutate_bytes,
            std::mt19937& random) {
  const std::size_t changes = 1 + below(kMaxChanges, random);
  for (std::size_t i = 0; i < changes && !drive.messages.empty(); ++i) {
    const std::size_t index = below(drive.messages.size(), random);
    drawnChange(random).change({drive, index, period, mutate_bytes, random});
  }
}

FuzzedDrive crossed(const FuzzedDrive& begin, const FuzzedDrive& end, std::mt19937& random) {
  FuzzedDrive both{begin.graph, begin.topics, {}};
  // The same share of both, as the stamps of all seeds begin at the same time.
  const double share = std::uniform_real_distribution<double>()(random);
  const auto cut = [share](const std::vector<TimedMessage>& messages) {
    return messages.begin() +
           static_cast<std::ptrdiff_t>(share * static_cast<double>(messages.size()));
  };
  both.messages.assign(begin.messages.begin(), cut(begin.messages));
  std::for_each(cut(end.messages), end.messages.end(), [&](TimedMessage message) {
    message.topic = topicIndexIn(both, end.topicOf(message));
    both.messages.push_back(std::move(message));
  });
  return both;
}

void shorten(FuzzedDrive& drive, std::size_t max_size) {
  std::size_t size = encode(drive).size();
  while (!drive.messages.empty() && size > max_size) {
    size -= encodedSize(drive.messages.back());
    drive.messages.pop_back();
  }
}

}  // namespace datmo::fuzz
