// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/alignment_conversion.h"

#include <cstdint>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

/// px, m, rad and s; maximum of a term and of its standard deviation: a less certain camera is not
/// mounted.
constexpr double kMaxOffset = 1e3;

}  // namespace

StereoAlignmentMessagePtr toMessage(const StereoAlignment& alignment, const std::string& frame) {
  auto message = boost::make_shared<StereoAlignmentMessage>();
  message->header.stamp = toTime(alignment.stamp);
  message->header.frame_id = frame;
  message->disparity_offset = alignment[AlignmentTerm::kDisparity];
  message->disparity_variance = alignment.variance(AlignmentTerm::kDisparity);
  message->surface_offset = alignment[AlignmentTerm::kSurface];
  message->surface_variance = alignment.variance(AlignmentTerm::kSurface);
  message->forward_offset = alignment[AlignmentTerm::kForward];
  message->forward_variance = alignment.variance(AlignmentTerm::kForward);
  message->heading_offset = alignment[AlignmentTerm::kHeading];
  message->heading_variance = alignment.variance(AlignmentTerm::kHeading);
  message->time_offset = alignment[AlignmentTerm::kTime];
  message->time_variance = alignment.variance(AlignmentTerm::kTime);
  message->surfaces = alignment.surfaces;
  message->agreement = alignment.agreement;
  message->usable = static_cast<std::uint8_t>(alignment.usable);
  return message;
}

StereoAlignment fromMessage(const StereoAlignmentMessage& message) {
  StereoAlignment alignment;
  alignment.stamp = toStamp(message.header.stamp);
  alignment.mean << message.disparity_offset, message.surface_offset, message.forward_offset,
      message.heading_offset, message.time_offset;
  AlignmentVector variances;
  variances << message.disparity_variance, message.surface_variance, message.forward_variance,
      message.heading_variance, message.time_variance;
  alignment.agreement = message.agreement;
  alignment.usable = message.usable != 0;
  // Comparisons with NaN are false.
  if (!(alignment.mean.array().abs() <= kMaxOffset).all() || !(variances.array() >= 0.0).all() ||
      !(variances.array() <= kMaxOffset * kMaxOffset).all()) {
    throw InputError(
        "bad_alignment",
        "alignment of the stereo camera with numbers that are not finite or implausible, or "
        "negative variances: expected offsets and variances of all terms");
  }
  alignment.covariance = variances.asDiagonal();
  alignment.surfaces = message.surfaces;
  return alignment;
}

}  // namespace datmo
