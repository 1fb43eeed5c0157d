// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/options.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace datmo {

namespace {

class Checker : public OptionVisitor {
 public:
  void number(const OptionInfo& info, double& value, const Bounds& bounds) override {
    if (std::isfinite(value) && value >= bounds.min && value <= bounds.max) {
      return;
    }
    std::ostringstream message;
    message << key(info) << " = " << value << ": expected a number from " << bounds.min << " to "
            << bounds.max << " " << info.unit << " (" << info.description << ")";
    throw OptionError(message.str());
  }

  void numbers(const OptionInfo& info, std::vector<double>& values, const Bounds& bounds) override {
    for (double& value : values) {
      number(info, value, bounds);
    }
  }

  void integer(const OptionInfo& info, int& value, const Bounds& bounds) override {
    double as_number = value;
    number(info, as_number, bounds);
  }

  void toggle(const OptionInfo& /*info*/, bool& /*value*/) override {}

  void text(const OptionInfo& info, std::string& value,
            const std::vector<std::string>& allowed) override {
    refuseUnlessAllowed(info, value, allowed);
  }
};

}  // namespace

void OptionVisitor::group(const std::string& name, const std::function<void()>& visit_members,
                          Tier max) {
  groups_.push_back({name, max});
  visit_members();
  groups_.pop_back();
}

std::string OptionVisitor::prefix() const {
  std::string prefix;
  for (const Group& group : groups_) {
    prefix += group.name + "/";
  }
  return prefix;
}

std::string OptionVisitor::key(const OptionInfo& info) const { return prefix() + info.name; }

Tier OptionVisitor::tier(const OptionInfo& info) const {
  Tier tier = info.tier;
  for (const Group& group : groups_) {
    tier = std::min(tier, group.max);
  }
  return tier;
}

void OptionVisitor::refuseUnlessAllowed(const OptionInfo& info, const std::string& value,
                                        const std::vector<std::string>& allowed) const {
  if (allowed.empty() || std::find(allowed.begin(), allowed.end(), value) != allowed.end()) {
    return;
  }
  std::string message = key(info) + " = '" + value + "': expected one of";
  for (const std::string& choice : allowed) {
    message += " '" + choice + "'";
  }
  throw OptionError(message + " (" + info.description + ")");
}

void detail::checkAll(const OptionWalk& visit) {
  Checker checker;
  visit(checker);
}

}  // namespace datmo
