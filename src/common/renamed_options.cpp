// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/renamed_options.h"

#include <map>
#include <sstream>

namespace datmo {

namespace {

/// Options and groups whose new name does not follow from the rule for `least_` and `most_`.
const std::map<std::string, std::string> kRenamed = {
    {"across_per_metre", "across_per_meter"},
    {"along_per_metre", "along_per_meter"},
    {"coincidence", "false_agreement_probability"},
    {"farthest", "max_distance"},
    {"highest", "max_height"},
    {"kerb_hit_probability", "curb_hit_probability"},
    {"largest_size", "max_size"},
    {"longest_gap", "max_gap"},
    {"longest_presence", "max_presence"},
    {"longest_silence", "max_silence"},
    {"longest_step", "max_step"},
    {"longest_sweep", "max_sweep"},
    {"longest_wait", "max_wait"},
    {"loyalty", "association_hysteresis"},
    {"max_readings", "max_interpretations"},
    {"memory_way", "memory_distance"},
    {"min_contradiction_rise", "min_kidnapped_log_ratio"},
    {"most_else", "max_other"},
    {"most_in_scan", "max_per_scan"},
    {"most_places", "max_points"},
    {"nearest_depth", "min_depth"},
    {"nearest_distance", "min_distance"},
    {"nearest_range", "min_range"},
    {"pixels_per_metre", "pixels_per_meter"},
    {"shortest_gap", "min_gap"},
    {"static_neighbourhood", "static_neighborhood"},
    {"twin_reach", "duplicate_gate_scale"},
    {"witness", "scan_support"},
};

bool startsWith(const std::string& text, const std::string& prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

std::string renamed(const std::string& name) {
  const auto found = kRenamed.find(name);
  if (found != kRenamed.end()) {
    return found->second;
  }
  for (const auto& [former, present] :
       {std::pair<std::string, std::string>("least_", "min_"), {"most_", "max_"}}) {
    if (startsWith(name, former)) {
      return present + name.substr(former.size());
    }
  }
  return name;
}

}  // namespace

std::optional<std::string> renamedOption(const std::string& key,
                                         const std::set<std::string>& keys) {
  std::istringstream names(key);
  std::string present;
  for (std::string name; std::getline(names, name, '/');) {
    present += (present.empty() ? "" : "/") + renamed(name);
  }
  return present != key && keys.count(present) > 0 ? std::optional(present) : std::nullopt;
}

}  // namespace datmo
