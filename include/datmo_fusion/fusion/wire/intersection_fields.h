// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "datmo_fusion/fusion/wire/its_fields.h"

namespace datmo {

// Fields common to SPATEM and MAPEM, by ISO/TS 19091 (2018), profile C, module DSRC.

/// DF IntersectionReferenceID.
struct IntersectionId {
  std::optional<std::int64_t> region;  ///< issuer of the number
  std::int64_t number = 0;

  bool operator<(const IntersectionId& other) const {
    return std::tie(region, number) < std::tie(other.region, other.number);
  }
};

/// For people: "12.3456", "3456".
std::string toText(const IntersectionId& id);

/// Throws WireError (`other_version`, `other_message`) for a message of another kind.
void walk(Uper& uper, ItsHeader& header, std::int64_t kind);
void walk(Uper& uper, IntersectionId& id);

/// A value that is optional (see Uper::present).
void walk(Uper& uper, bool is_there, std::optional<std::int64_t>& value, std::int64_t min,
          std::int64_t max);

/// DescriptiveName, which is skipped.
void skipName(Uper& uper);

/// RegionalExtension, and a list of one to four of them.
void skipRegional(Uper& uper);
void skipRegionals(Uper& uper);

/// The end of a SEQUENCE: regional extensions, then additions of later versions.
void skipEnd(Uper& uper, bool has_regional, bool is_extended);

/// A BIT STRING of fixed size as a number whose most significant bit is the first one.
inline void walkBits(Uper& uper, std::int64_t& value, unsigned size) {
  uper.integer(value, 0, (std::int64_t{1} << size) - 1);
}

/// An ENUMERATED with values beyond its root, which is skipped.
void skipEnumerated(Uper& uper, std::int64_t last);

/// SEQUENCE (SIZE(min..max)) OF.
template <typename Item, typename Walk>
void walkList(Uper& uper, std::vector<Item>& items, std::int64_t min, std::int64_t max,
              const Walk& walk_item) {
  auto count = static_cast<std::int64_t>(items.size());
  uper.integer(count, min, max);
  items.resize(static_cast<std::size_t>(count));
  for (Item& item : items) {
    walk_item(uper, item);
  }
}

/// The same for skipped items.
template <typename Skip>
void skipList(Uper& uper, std::int64_t max, const Skip& skip_item) {
  std::int64_t count = 1;
  uper.integer(count, 1, max);
  for (std::int64_t i = 0; i < count; ++i) {
    skip_item(uper);
  }
}

}  // namespace datmo
