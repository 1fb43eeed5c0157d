// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/attainable_json.h"

#include <optional>

#include "evaluate/json_number.h"

#include "datmo_fusion/common/quantile.h"

namespace datmo::evaluation {

namespace {

using nlohmann::json;

/// Of some of the objects.
class DelayList {
 public:
  void add(const ObjectScore& object, const ComparedDelay& delay) {
    ++objects_;
    detectable_ += delay.attainable ? 1 : 0;
    missed_ += delay.attainable && !object.found() ? 1 : 0;
    append(object.delay, delay_);
    append(delay.attainable, attainable_);
    append(delay.excess, excess_);
    append(delay.ratio, ratio_);
  }

  json toJson() const {
    return {{"objects", objects_},
            {"detectable", detectable_},
            {"detectable_but_missed", missed_},
            {"delay_s", quantiles(delay_)},
            {"attainable_s", quantiles(attainable_)},
            {"excess_s", quantiles(excess_)},
            {"ratio", quantiles(ratio_)}};
  }

 private:
  static void append(const std::optional<double>& value, std::vector<double>& values) {
    if (value) {
      values.push_back(*value);
    }
  }

  static json quantiles(const std::vector<double>& values) {
    if (values.empty()) {
      return {{"median", nullptr}, {"p90", nullptr}};
    }
    return {{"median", quantile(values, 0.5)}, {"p90", quantile(values, 0.9)}};
  }

  int objects_ = 0;
  int detectable_ = 0;
  int missed_ = 0;
  std::vector<double> delay_;
  std::vector<double> attainable_;
  std::vector<double> excess_;
  std::vector<double> ratio_;
};

}  // namespace

json delaysJson(const std::vector<ObjectScore>& objects, const std::vector<ComparedDelay>& delays) {
  DelayList all;
  std::map<std::string, DelayList> by_class;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    all.add(objects[i], delays[i]);
    by_class[nameOf(objects[i].classification)].add(objects[i], delays[i]);
  }
  json result = all.toJson();
  result["by_class"] = json::object();
  for (const auto& [name, list] : by_class) {
    result["by_class"][name] = list.toJson();
  }
  return result;
}

void addDelays(const std::vector<ComparedDelay>& delays, json& objects) {
  for (std::size_t i = 0; i < delays.size(); ++i) {
    objects[i].update({{"attainable_delay_s", orNull(delays[i].attainable)},
                       {"excess_delay_s", orNull(delays[i].excess)},
                       {"delay_ratio", orNull(delays[i].ratio)},
                       {"beams_per_scan", delays[i].beams_per_scan}});
  }
}

}  // namespace datmo::evaluation
