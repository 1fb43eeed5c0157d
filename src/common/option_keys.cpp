// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/option_keys.h"

namespace datmo {

namespace {

class KeyCollector : public OptionVisitor {
 public:
  void number(const OptionInfo& info, double& /*value*/, const Bounds& /*bounds*/) override {
    keys_.push_back(key(info));
  }

  void integer(const OptionInfo& info, int& /*value*/, const Bounds& /*bounds*/) override {
    keys_.push_back(key(info));
  }

  void numbers(const OptionInfo& info, std::vector<double>& /*values*/,
               const Bounds& /*bounds*/) override {
    keys_.push_back(key(info));
  }

  void toggle(const OptionInfo& info, bool& /*value*/) override { keys_.push_back(key(info)); }

  void text(const OptionInfo& info, std::string& /*value*/,
            const std::vector<std::string>& /*allowed*/) override {
    keys_.push_back(key(info));
  }

  const std::vector<std::string>& keys() const { return keys_; }

 private:
  std::vector<std::string> keys_;
};

}  // namespace

std::vector<std::string> detail::keysOf(const OptionWalk& visit) {
  KeyCollector collector;
  visit(collector);
  return collector.keys();
}

}  // namespace datmo
