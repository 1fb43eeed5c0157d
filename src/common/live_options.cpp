// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/live_options.h"

#include <algorithm>

namespace datmo {

namespace {

class LiveCollector : public OptionVisitor {
 public:
  void number(const OptionInfo& info, double& value, const Bounds& bounds) override {
    add(info, value, bounds, {});
  }

  void integer(const OptionInfo& info, int& value, const Bounds& bounds) override {
    add(info, value, bounds, {});
  }

  void numbers(const OptionInfo& info, std::vector<double>& values, const Bounds& bounds) override {
    add(info, values, bounds, {});
  }

  void toggle(const OptionInfo& info, bool& value) override { add(info, value, {}, {}); }

  void text(const OptionInfo& info, std::string& value,
            const std::vector<std::string>& allowed) override {
    add(info, value, {}, allowed);
  }

  const std::vector<LiveOption>& options() const { return options_; }

 private:
  void add(const OptionInfo& info, const OptionValue& value, const Bounds& bounds,
           const std::vector<std::string>& choices) {
    if (tier(info) == Tier::kLive) {
      options_.push_back({key(info), info.description, value, bounds, choices});
    }
  }

  std::vector<LiveOption> options_;
};

}  // namespace

std::vector<LiveOption> detail::liveOptionsOf(const OptionWalk& visit) {
  LiveCollector collector;
  visit(collector);
  return collector.options();
}

void detail::setLive(const OptionValues& values, const OptionWalk& visit) {
  const std::vector<LiveOption> live = liveOptionsOf(visit);
  for (const auto& [key, value] : values) {
    const bool known =
        std::any_of(live.begin(), live.end(),
                    [&name = key](const LiveOption& option) { return option.key == name; });
    if (!known) {
      throw OptionError(key + " = " + toText(value) +
                        ": expected an option that may be changed while the stage runs");
    }
  }
  readAll(values, visit);
}

}  // namespace datmo
