// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/clock_check.h"

#include <cmath>
#include <cstdio>

namespace datmo {

namespace {

/// "0.100 s ahead of" or "0.100 s behind".
std::string offsetInWords(double ahead) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3f s %s", std::abs(ahead),
                ahead > 0.0 ? "ahead of" : "behind");
  return text;
}

std::string stepSentence(const std::string& input, double ahead) {
  return "stamps of " + input + " are " + offsetInWords(ahead) +
         " the sensor's previous clock, while its messages arrive as before: that clock was set; "
         "corrects its stamps by this offset";
}

std::string takenSentence(const std::string& input, double ahead) {
  return "stamps of " + input + " stay " + offsetInWords(ahead) +
         " the sensor's previous clock, which may have been wrong, or the new stamps are right: "
         "that clock "
         "was set; uses them uncorrected";
}

std::string leadSentence(const std::string& input, double lead) {
  return "messages of " + input + " arrive at least " + offsetInWords(lead) +
         " their stamps: expected after them; the sensor's clock is ahead, or the clock of this "
         "computer or of the recording is behind: synchronize them";
}

/// Whether ros::Time can represent it; 0 is not a valid time.
bool isTime(Stamp stamp) { return stamp > Stamp{} && stamp <= toStamp(ros::TIME_MAX); }

}  // namespace

ros::Time ClockCheck::corrected(const ros::Time& stamp, Stamp now) {
  if (stamp.isZero()) {
    return stamp;
  }
  const double before = clock_.ahead();
  const std::uint64_t taken_before = clock_.taken();
  const double ahead = clock_.add(toStamp(stamp), now);
  if (ahead != before) {
    monitor_.figure("clock of " + input_ + " ahead [s]", ahead);
  }
  if (clock_.taken() > taken_before) {
    monitor_.warned(InputError("clock_set", takenSentence(input_, before)));
  }
  if (clock_.lead() > 0.0) {
    monitor_.warned(InputError("clock_ahead", leadSentence(input_, clock_.lead())));
  }
  if (ahead == 0.0) {
    return stamp;
  }
  monitor_.warned(InputError("clock_off", stepSentence(input_, ahead)));
  const Stamp right = toStamp(stamp) + -ahead;
  return isTime(right) ? toTime(right) : stamp;
}

}  // namespace datmo
