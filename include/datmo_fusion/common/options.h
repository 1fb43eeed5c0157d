// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace datmo {

/// Who sets an option.
enum class Tier {
  kExpert,  ///< part of the method: who knows it, its tests, the thesis's preset
  kPublic,  ///< who has another sensor, vehicle or city
  kLive     ///< the same, also while the stage runs
};

/// What a person who sets an option must know about it; stands once, where the option is declared.
struct OptionInfo {
  std::string name;         ///< key in the yaml file
  std::string unit;         ///< "m", "s", "1" for a pure number, "" for text and switches
  std::string description;  ///< what it does, and its source: thesis section or paper
  Tier tier = Tier::kExpert;
};

/// Closed interval of the values that an option may take.
struct Bounds {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// An option that has no valid value: the message names it, its value and what was expected.
class OptionError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Walks over the options of a stage. Each `Options` struct of the core declares its members to a
/// visitor in one function, `void visit(OptionVisitor&)`; reading, checking and documenting them
/// are visitors, so that nothing is said twice.
class OptionVisitor {
 public:
  virtual ~OptionVisitor() = default;

  virtual void number(const OptionInfo& info, double& value, const Bounds& bounds) = 0;
  virtual void integer(const OptionInfo& info, int& value, const Bounds& bounds) = 0;
  /// Any number of them, each within the bounds.
  virtual void numbers(const OptionInfo& info, std::vector<double>& values,
                       const Bounds& bounds) = 0;
  virtual void toggle(const OptionInfo& info, bool& value) = 0;
  /// Text; `allowed` empty: any text.
  virtual void text(const OptionInfo& info, std::string& value,
                    const std::vector<std::string>& allowed) = 0;

  /// Options that stand under a common key: `name/…`. None of them is of a higher tier than `max`.
  void group(const std::string& name, const std::function<void()>& visit_members,
             Tier max = Tier::kLive);

  /// The same options for each of several entries, under the name of each: `name/lidar/…`,
  /// `name/stereo/…`. A name that is set but was not there is one more entry, with the defaults of
  /// `Options`.
  template <typename Options>
  void each(const OptionInfo& info, std::map<std::string, Options>& entries) {
    group(info.name, [&] {
      for (const std::string& name : namesSet()) {
        entries.try_emplace(name);
      }
      for (auto& [name, options] : entries) {
        group(name, [this, &entry = options] { entry.visit(*this); });
      }
    });
  }

 protected:
  /// The names that somebody has set directly under the groups around.
  virtual std::vector<std::string> namesSet() const { return {}; }

  /// The key of the groups around, with a slash at its end; empty outside of all.
  std::string prefix() const;

  /// The full key of an option: the names of the groups around it, and its own.
  std::string key(const OptionInfo& info) const;

  /// The tier of an option within the groups around it.
  Tier tier(const OptionInfo& info) const;

 private:
  struct Group {
    std::string name;
    Tier max;
  };

  std::vector<Group> groups_;
};

/// What somebody has set, by full key (`map/cell_size`), wherever it was read from.
using OptionValue = std::variant<bool, int, double, std::string, std::vector<double>>;
using OptionValues = std::map<std::string, OptionValue>;

/// As in a yaml file; text in quotes, numbers in brackets.
std::string toText(const OptionValue& value);

namespace detail {
using OptionWalk = std::function<void(OptionVisitor&)>;
void checkAll(const OptionWalk& visit);
void readAll(const OptionValues& values, const OptionWalk& visit);
}  // namespace detail

/// Throws OptionError for the first option whose value is not finite, out of bounds or not allowed.
template <typename Options>
void checkOptions(const Options& options) {
  Options copy = options;
  detail::checkAll([&copy](OptionVisitor& visitor) { copy.visit(visitor); });
}

/// The defaults of the options, overridden by `values`, checked. A whole number serves where a
/// number is wanted.
///
/// Throws OptionError for a value of the wrong type, one that checkOptions refuses, and a key that
/// no option has (a misspelled one): the message names the nearest key there is.
template <typename Options>
Options readOptions(const OptionValues& values) {
  Options options;
  detail::readAll(values, [&options](OptionVisitor& visitor) { options.visit(visitor); });
  checkOptions(options);
  return options;
}

}  // namespace datmo
