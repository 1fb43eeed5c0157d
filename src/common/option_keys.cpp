// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/option_keys.h"

#include "datmo_fusion/common/option_texts.h"

namespace datmo {

namespace {

class ValueCollector : public OptionVisitor {
 public:
  void number(const OptionInfo& info, double& value, const Bounds& /*bounds*/) override {
    values_.emplace_back(key(info), value);
  }

  void integer(const OptionInfo& info, int& value, const Bounds& /*bounds*/) override {
    values_.emplace_back(key(info), value);
  }

  void numbers(const OptionInfo& info, std::vector<double>& values,
               const Bounds& /*bounds*/) override {
    values_.emplace_back(key(info), values);
  }

  void toggle(const OptionInfo& info, bool& value) override {
    values_.emplace_back(key(info), value);
  }

  void text(const OptionInfo& info, std::string& value,
            const std::vector<std::string>& /*allowed*/) override {
    values_.emplace_back(key(info), value);
  }

  const std::vector<std::pair<std::string, OptionValue>>& values() const { return values_; }

 private:
  std::vector<std::pair<std::string, OptionValue>> values_;
};

}  // namespace

std::vector<std::pair<std::string, OptionValue>> detail::valuesOf(const OptionWalk& visit) {
  ValueCollector collector;
  visit(collector);
  return collector.values();
}

std::vector<std::string> detail::keysOf(const OptionWalk& visit) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : valuesOf(visit)) {
    keys.push_back(key);
  }
  return keys;
}

}  // namespace datmo
