// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace datmo {

/// Who is expected to set an option.
enum class Tier {
  kExpert,  ///< part of the method: set by experts, tests and the thesis preset
  kPublic,  ///< users with another sensor, vehicle or city
  kLive     ///< as kPublic, also while the stage runs
};

/// What a user must know about an option; written once, where the option is declared.
struct OptionInfo {
  std::string name;         ///< key in the yaml file
  std::string unit;         ///< "m", "s", "1" for a pure number, "" for text and switches
  std::string description;  ///< what it does, and its source: thesis section or paper
  Tier tier = Tier::kExpert;
};

/// Closed interval of the values that an option can take.
struct Bounds {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// An option without a valid value; the message gives its name, its value and what was expected.
class OptionError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// The values of an enumerated option, by their names in the yaml file.
template <typename Enum>
using Choices = std::vector<std::pair<std::string, Enum>>;

/// Visits the options of a stage. Each `Options` struct of the core declares its members in one
/// function, `void visit(OptionVisitor&)`; reading, checking and documenting options are visitors,
/// so that each option is declared only once. A member that visit() leaves out belongs to the
/// method and is no parameter: code and tests set it, and its comment has its unit, valid range and
/// source.
class OptionVisitor {
 public:
  virtual ~OptionVisitor() = default;

  virtual void number(const OptionInfo& info, double& value, const Bounds& bounds) = 0;
  virtual void integer(const OptionInfo& info, int& value, const Bounds& bounds) = 0;
  /// A list of any length, each number within the bounds.
  virtual void numbers(const OptionInfo& info, std::vector<double>& values,
                       const Bounds& bounds) = 0;
  virtual void toggle(const OptionInfo& info, bool& value) = 0;
  /// Text; `allowed` empty: any text.
  virtual void text(const OptionInfo& info, std::string& value,
                    const std::vector<std::string>& allowed) = 0;

  /// One of several values. Throws OptionError for a name or a value that is not among them.
  template <typename Enum>
  void choice(const OptionInfo& info, Enum& value, const Choices<Enum>& choices) {
    std::vector<std::string> names;
    std::string name;
    for (const auto& [known, meant] : choices) {
      names.push_back(known);
      name = meant == value ? known : name;
    }
    text(info, name, names);
    refuseUnlessAllowed(info, name, names);
    for (const auto& [known, meant] : choices) {
      value = known == name ? meant : value;
    }
  }

  /// Options under a common key: `name/…`. None of them has a higher tier than `max`.
  void group(const std::string& name, const std::function<void()>& visit_members,
             Tier max = Tier::kLive);

  /// The same options for each of several entries, under the name of each: `name/lidar/…`,
  /// `name/stereo/…`. A name that is set but has no entry yet adds one, with the defaults of
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
  /// Returns the names that are set directly under the current groups.
  virtual std::vector<std::string> namesSet() const { return {}; }

  /// Returns the key of the current groups, with a slash at its end; empty outside of all groups.
  std::string prefix() const;

  /// Returns the full key of an option: the names of the current groups, and its own.
  std::string key(const OptionInfo& info) const;

  /// Throws OptionError for a text that is not allowed; if `allowed` is empty, any text is.
  void refuseUnlessAllowed(const OptionInfo& info, const std::string& value,
                           const std::vector<std::string>& allowed) const;

  /// Returns the tier of an option within the current groups.
  Tier tier(const OptionInfo& info) const;

 private:
  struct Group {
    std::string name;
    Tier max;
  };

  std::vector<Group> groups_;
};

/// The values that were set, by full key (`map/cell_size`), from any origin.
using OptionValue = std::variant<bool, int, double, std::string, std::vector<double>>;
using OptionValues = std::map<std::string, OptionValue>;

/// Returns the value as in a yaml file: text in quotes, numbers in brackets.
std::string toText(const OptionValue& value);

namespace detail {
using OptionWalk = std::function<void(OptionVisitor&)>;
void checkAll(const OptionWalk& visit);
/// Calls `Options::check() const`, if it exists, which checks options against each other.
template <typename Options>
auto checkTogether(const Options& options, int /*preferred*/) -> decltype(options.check()) {
  options.check();
}
template <typename Options>
void checkTogether(const Options& /*options*/, long /*otherwise*/) {}
void readAll(const OptionValues& values, const OptionWalk& visit);
}  // namespace detail

/// Throws OptionError for the first option whose value is not finite, out of bounds or not allowed,
/// and whatever `Options::check() const`, if it exists, throws for options that contradict each
/// other.
template <typename Options>
void checkOptions(const Options& options) {
  Options copy = options;
  detail::checkAll([&copy](OptionVisitor& visitor) { copy.visit(visitor); });
  detail::checkTogether(options, 0);
}

/// Valid options: they are checked on construction, so functions that take them need not check.
template <typename Options>
class Checked {
 public:
  /// The defaults.
  Checked() : Checked(Options()) {}

  /// Throws OptionError as checkOptions does. Implicit, so that plain options can be passed.
  Checked(Options options) : options_(std::move(options)) { checkOptions(options_); }

  const Options& operator*() const { return options_; }
  const Options* operator->() const { return &options_; }

 private:
  Options options_;
};

/// Returns the defaults of the options, overridden by `values` and checked. An integer is accepted
/// for a floating-point option.
///
/// Throws OptionError for a value of the wrong type, a value that checkOptions rejects, and an
/// unknown key (a misspelled one): the message suggests the nearest known key.
template <typename Options>
Options readOptions(const OptionValues& values) {
  Options options;
  detail::readAll(values, [&options](OptionVisitor& visitor) { options.visit(visitor); });
  checkOptions(options);
  return options;
}

}  // namespace datmo
