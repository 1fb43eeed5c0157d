// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <stdexcept>
#include <string>

#include "datmo_fusion/grid/cell_evidence.h"

namespace datmo {

/// Thrown for a map file that cannot be read or written; the message names it and says what is
/// wrong, and what was expected.
class MapFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns the CRC-32 of these bytes.
std::uint32_t checksumOf(const std::string& bytes);

/// Bytes of a cell in the text of a map.
inline constexpr std::size_t kMapBytesPerCell = 48;

/// Returns a map as in its file: a header in text, then the cells.
std::string mapText(const MapEvidence& evidence);

/// Reads a map that ends with the stream, which comes from `file`. Throws MapFileError: another
/// format, truncated, modified, or with invalid evidence.
MapEvidence readMapText(std::istream& in, const std::string& file);

}  // namespace datmo
