// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/wire/spatem.h"

namespace datmo {

namespace {

constexpr std::int64_t kMaxZone = 10000;
constexpr std::int64_t kMaxEvents = 16;

/// DF AdvisorySpeed; its confidence has the eight values of SAE J2735.
void skipAdvisorySpeed(Uper& uper) {
  const bool is_extended = uper.extended();
  const bool has_speed = uper.present(false);
  const bool has_confidence = uper.present(false);
  const bool has_distance = uper.present(false);
  const bool has_class = uper.present(false);
  const bool has_regional = uper.present(false);
  skipEnumerated(uper, 3);
  if (has_speed) {
    uper.skipInteger(0, 500);
  }
  if (has_confidence) {
    uper.skipInteger(0, 7);
  }
  if (has_distance) {
    uper.skipInteger(0, kMaxZone);
  }
  if (has_class) {
    uper.skipInteger(0, kItsByteMax);
  }
  skipEnd(uper, has_regional, is_extended);
}

/// DF ConnectionManeuverAssist.
void skipAssist(Uper& uper) {
  const bool is_extended = uper.extended();
  const bool has_queue = uper.present(false);
  const bool has_storage = uper.present(false);
  const bool has_wait = uper.present(false);
  const bool has_detection = uper.present(false);
  const bool has_regional = uper.present(false);
  uper.skipInteger(0, kItsByteMax);
  for (const bool has_length : {has_queue, has_storage}) {
    if (has_length) {
      uper.skipInteger(0, kMaxZone);
    }
  }
  for (const bool has_flag : {has_wait, has_detection}) {
    if (has_flag) {
      uper.skipInteger(0, 1);
    }
  }
  skipEnd(uper, has_regional, is_extended);
}

void walkTiming(Uper& uper, SpatTiming& timing) {
  const bool has_start = uper.present(timing.start.has_value());
  const bool has_max = uper.present(timing.max_end.has_value());
  const bool has_likely = uper.present(timing.likely.has_value());
  const bool has_confidence = uper.present(timing.confidence.has_value());
  const bool has_next = uper.present(timing.next.has_value());
  walk(uper, has_start, timing.start, 0, SpatTiming::kUnknown);
  uper.integer(timing.min_end, 0, SpatTiming::kUnknown);
  walk(uper, has_max, timing.max_end, 0, SpatTiming::kUnknown);
  walk(uper, has_likely, timing.likely, 0, SpatTiming::kUnknown);
  walk(uper, has_confidence, timing.confidence, 0, 15);
  walk(uper, has_next, timing.next, 0, SpatTiming::kUnknown);
}

void walkEvent(Uper& uper, SpatEvent& event) {
  const bool is_extended = uper.extended();
  const bool has_timing = uper.present(event.timing.has_value());
  const bool has_speeds = uper.present(false);
  const bool has_regional = uper.present(false);
  auto state = static_cast<std::int64_t>(event.state);
  uper.integer(state, 0, static_cast<std::int64_t>(SignalState::kCaution));
  event.state = static_cast<SignalState>(state);
  if (has_timing) {
    SpatTiming timing = event.timing.value_or(SpatTiming());
    walkTiming(uper, timing);
    event.timing = timing;
  }
  if (has_speeds) {
    skipList(uper, 16, skipAdvisorySpeed);
  }
  skipEnd(uper, has_regional, is_extended);
}

void walkMovement(Uper& uper, SpatMovement& movement) {
  const bool is_extended = uper.extended();
  const bool has_name = uper.present(false);
  const bool has_assists = uper.present(false);
  const bool has_regional = uper.present(false);
  if (has_name) {
    skipName(uper);
  }
  uper.integer(movement.group, 0, kItsByteMax);
  walkList(uper, movement.events, 1, kMaxEvents, walkEvent);
  if (has_assists) {
    skipList(uper, 16, skipAssist);
  }
  skipEnd(uper, has_regional, is_extended);
}

void walkIntersectionState(Uper& uper, SpatIntersection& intersection) {
  const bool is_extended = uper.extended();
  const bool has_name = uper.present(false);
  const bool has_minute = uper.present(intersection.minute.has_value());
  const bool has_time = uper.present(intersection.millisecond.has_value());
  const bool has_lanes = uper.present(false);
  const bool has_assists = uper.present(false);
  const bool has_regional = uper.present(false);
  if (has_name) {
    skipName(uper);
  }
  walk(uper, intersection.id);
  uper.integer(intersection.revision, 0, 127);
  walkBits(uper, intersection.status, 16);
  walk(uper, has_minute, intersection.minute, 0, SpatIntersection::kNoMinute);
  walk(uper, has_time, intersection.millisecond, 0, 65535);
  if (has_lanes) {
    skipList(uper, 16, [](Uper& one) { one.skipInteger(0, kItsByteMax); });
  }
  walkList(uper, intersection.movements, 1, 255, walkMovement);
  if (has_assists) {
    skipList(uper, 16, skipAssist);
  }
  skipEnd(uper, has_regional, is_extended);
}

/// Ignores everything after the intersections.
void walkSpatem(Uper& uper, Spatem& message) {
  walk(uper, message.header, ItsHeader::kSpatem);
  uper.extended();
  const bool has_minute = uper.present(message.minute.has_value());
  const bool has_name = uper.present(false);
  uper.present(false);  // regional
  walk(uper, has_minute, message.minute, 0, SpatIntersection::kNoMinute);
  if (has_name) {
    skipName(uper);
  }
  walkList(uper, message.intersections, 1, 32, walkIntersectionState);
}

}  // namespace

std::string encode(Spatem message) {
  UperWriter writer;
  walkSpatem(writer, message);
  return writer.bytes();
}

Spatem decodeSpatem(std::string_view bytes) {
  UperReader reader(bytes);
  Spatem message;
  walkSpatem(reader, message);
  return message;
}

}  // namespace datmo
