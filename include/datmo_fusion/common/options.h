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

/// The values of an option that is one of several, by their names in the yaml file.
template <typename Enum>
using Choices = std::vector<std::pair<std::string, Enum>>;

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

  /// One of several. Throws OptionError for a name or a value that is none of them.
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

  /// Throws OptionError for a text that is none of the allowed ones; if there are none, any is.
  void refuseUnlessAllowed(const OptionInfo& info, const std::string& value,
                           const std::vector<std::string>& allowed) const;

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
/// Calls `Options::check() const`, where there is one: what options have to do with each other.
template <typename Options>
auto checkTogether(const Options& options, int /*preferred*/) -> decltype(options.check()) {
  options.check();
}
template <typename Options>
void checkTogether(const Options& /*options*/, long /*otherwise*/) {}
void readAll(const OptionValues& values, const OptionWalk& visit);
}  // namespace detail

/// Throws OptionError for the first option whose value is not finite, out of bounds or not allowed,
/// and as `Options::check() const`, where there is one, does for options that contradict each
/// other.
template <typename Options>
void checkOptions(const Options& options) {
  Options copy = options;
  detail::checkAll([&copy](OptionVisitor& visitor) { copy.visit(visitor); });
  detail::checkTogether(options, 0);
}

/// Options that are valid: there are none but by their check, so who is given them need not check.
template <typename Options>
class Checked {
 public:
  /// The defaults.
  Checked() : Checked(Options()) {}

  /// Throws OptionError as checkOptions does. Implicit: options are passed as they are.
  Checked(Options options) : options_(std::move(options)) { checkOptions(options_); }

  const Options& operator*() const { return options_; }
  const Options* operator->() const { return &options_; }

 private:
  Options options_;
};

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
