// SPDX-License-Identifier: BSD-3-Clause
#include <set>
#include <sstream>

#include "datmo_fusion/common/nearest_name.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/renamed_options.h"

namespace datmo {

namespace {

/// Sets options from values and records which keys exist.
class Reader : public OptionVisitor {
 public:
  explicit Reader(const OptionValues& values) : values_(values) {}

  void number(const OptionInfo& info, double& value, const Bounds& /*bounds*/) override {
    if (const OptionValue* given = find(info)) {
      if (const int* whole = std::get_if<int>(given)) {
        value = *whole;
      } else {
        value = as<double>(info, *given, "a number");
      }
    }
  }

  void numbers(const OptionInfo& info, std::vector<double>& values,
               const Bounds& /*bounds*/) override {
    set(info, values, "a list of numbers");
  }

  void integer(const OptionInfo& info, int& value, const Bounds& /*bounds*/) override {
    set(info, value, "a whole number");
  }

  void toggle(const OptionInfo& info, bool& value) override { set(info, value, "true or false"); }

  void text(const OptionInfo& info, std::string& value,
            const std::vector<std::string>& /*allowed*/) override {
    set(info, value, "text");
  }

  const std::set<std::string>& keys() const { return keys_; }

 protected:
  std::vector<std::string> namesSet() const override {
    const std::string groups = prefix();
    std::vector<std::string> names;
    for (auto given = values_.lower_bound(groups);
         given != values_.end() && given->first.compare(0, groups.size(), groups) == 0; ++given) {
      const std::size_t end = given->first.find('/', groups.size());
      // A value directly under the group is not an entry; it will be rejected as an unknown key.
      if (end != std::string::npos) {
        names.push_back(given->first.substr(groups.size(), end - groups.size()));
      }
    }
    return names;
  }

 private:
  template <typename Type>
  void set(const OptionInfo& info, Type& value, const std::string& expected) {
    if (const OptionValue* given = find(info)) {
      value = as<Type>(info, *given, expected);
    }
  }

  template <typename Type>
  Type as(const OptionInfo& info, const OptionValue& given, const std::string& expected) {
    if (const Type* value = std::get_if<Type>(&given)) {
      return *value;
    }
    throw OptionError(key(info) + " = " + toText(given) + ": expected " + expected + " (" +
                      info.description + ")");
  }

  const OptionValue* find(const OptionInfo& info) {
    const std::string full_key = key(info);
    if (!keys_.insert(full_key).second) {
      throw std::logic_error("two options have the name " + full_key);
    }
    const auto found = values_.find(full_key);
    return found == values_.end() ? nullptr : &found->second;
  }

  const OptionValues& values_;
  std::set<std::string> keys_;
};

}  // namespace

std::string toText(const OptionValue& value) {
  if (const bool* toggle = std::get_if<bool>(&value)) {
    return *toggle ? "true" : "false";
  }
  if (const std::string* text = std::get_if<std::string>(&value)) {
    return "'" + *text + "'";
  }
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    std::string text;
    for (const double number : *numbers) {
      text += (text.empty() ? "" : ", ") + toText(OptionValue(number));
    }
    return "[" + text + "]";
  }
  std::ostringstream out;
  if (const int* whole = std::get_if<int>(&value)) {
    out << *whole;
  } else {
    out << std::get<double>(value);
  }
  return out.str();
}

void detail::readAll(const OptionValues& values, const OptionWalk& visit) {
  Reader reader(values);
  visit(reader);
  for (const auto& [key, value] : values) {
    if (reader.keys().count(key) == 0) {
      if (const auto renamed = renamedOption(key, reader.keys())) {
        throw OptionError(key + " = " + toText(value) + ": the option was renamed, expected " +
                          *renamed);
      }
      const std::string hint =
          reader.keys().empty() ? "no option at all" : nearestName(key, reader.keys());
      throw OptionError(key + " = " + toText(value) +
                        ": expected a known key; the nearest one is " + hint);
    }
  }
}

}  // namespace datmo
