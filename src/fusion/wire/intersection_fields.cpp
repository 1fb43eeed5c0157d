// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/wire/intersection_fields.h"

#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo {

std::string toText(const IntersectionId& id) {
  return (id.region ? std::to_string(*id.region) + "." : "") + std::to_string(id.number);
}

void walk(Uper& uper, ItsHeader& header, std::int64_t kind) {
  walkFields(uper, header);
  if (header.message != kind) {
    throw WireError("other_message", "a message of kind " + std::to_string(header.message) +
                                         ": expected " + std::to_string(kind));
  }
  checkVersion(header);
}

void walk(Uper& uper, IntersectionId& id) {
  constexpr std::int64_t kMax = 65535;
  const bool has_region = uper.present(id.region.has_value());
  walk(uper, has_region, id.region, 0, kMax);
  uper.integer(id.number, 0, kMax);
}

void walk(Uper& uper, bool is_there, std::optional<std::int64_t>& value, std::int64_t min,
          std::int64_t max) {
  if (!is_there) {
    value.reset();
    return;
  }
  std::int64_t number = value.value_or(min);
  uper.integer(number, min, max);
  value = number;
}

void skipName(Uper& uper) {
  constexpr std::int64_t kLongest = 63;
  constexpr std::int64_t kIa5 = 127;  // seven bits a character
  skipList(uper, kLongest, [](Uper& one) { one.skipInteger(0, kIa5); });
}

void skipRegional(Uper& uper) {
  uper.skipInteger(0, kItsByteMax);
  uper.skipOpenType();
}

void skipRegionals(Uper& uper) {
  constexpr std::int64_t kMost = 4;
  skipList(uper, kMost, [](Uper& one) { skipRegional(one); });
}

void skipEnd(Uper& uper, bool has_regional, bool is_extended) {
  if (has_regional) {
    skipRegionals(uper);
  }
  if (is_extended) {
    uper.skipAdditions();
  }
}

void skipEnumerated(Uper& uper, std::int64_t last) {
  if (uper.extended()) {
    uper.skipSmallNumber();
  } else {
    uper.skipInteger(0, last);
  }
}

}  // namespace datmo
