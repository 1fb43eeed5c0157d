// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/map_format.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include <boost/crc.hpp>

#include "datmo_fusion/grid/grid_window.h"

namespace datmo {

namespace {

constexpr char kMapFormat[] = "datmo_fusion map 1";

/// Per cell: log odds, age and hits as floats, indices and counters as integers; little endian.
constexpr std::size_t kBytesPerWord = 4;
constexpr std::size_t kBitsPerByte = 8;
constexpr std::uint32_t kByteMask = 0xFF;

/// Maximum number of cells: 2 km x 2 km with cells of 0.2 m, without an unknown one. They take
/// about as much memory as large computers have.
constexpr std::size_t kMaxCells = 100'000'000;

/// Maximum number of scans that a cell counts: years.
constexpr int kMaxCount = 1'000'000'000;

void append(std::string& bytes, std::uint32_t word) {
  for (std::size_t i = 0; i < kBytesPerWord; ++i) {
    bytes.push_back(static_cast<char>((word >> (kBitsPerByte * i)) & kByteMask));
  }
}

void append(std::string& bytes, std::int32_t value) {
  append(bytes, static_cast<std::uint32_t>(value));
}

void append(std::string& bytes, float value) {
  std::uint32_t word = 0;
  std::memcpy(&word, &value, sizeof word);
  append(bytes, word);
}

/// Reads the words of a file sequentially.
class WordReader {
 public:
  explicit WordReader(const std::string& bytes) : bytes_(bytes) {}

  std::int32_t integer() { return static_cast<std::int32_t>(word()); }

  float number() {
    const std::uint32_t bits = word();
    float value = 0.0F;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

 private:
  std::uint32_t word() {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < kBytesPerWord; ++i) {
      const auto byte = static_cast<unsigned char>(bytes_[at_++]);
      word |= static_cast<std::uint32_t>(byte) << (kBitsPerByte * i);
    }
    return word;
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
};

std::string bytesOf(const MapEvidence& evidence) {
  std::string bytes;
  bytes.reserve(evidence.cells.size() * kMapBytesPerCell);
  for (const CellEvidence& known : evidence.cells) {
    append(bytes, known.cell.column);
    append(bytes, known.cell.row);
    append(bytes, known.log_odds);
    append(bytes, known.age);
    append(bytes, known.refuted);
    append(bytes, known.believed);
    append(bytes, known.hits.count);
    for (const float sum : known.hits.sum) {
      append(bytes, sum);
    }
    for (const float square : known.hits.squares) {
      append(bytes, square);
    }
  }
  return bytes;
}

CellEvidence readCell(WordReader& words) {
  CellEvidence known;
  known.cell.column = words.integer();
  known.cell.row = words.integer();
  known.log_odds = words.number();
  known.age = words.number();
  known.refuted = words.integer();
  known.believed = words.integer();
  known.hits.count = words.number();
  for (float& sum : known.hits.sum) {
    sum = words.number();
  }
  for (float& square : known.hits.squares) {
    square = words.number();
  }
  return known;
}

bool isSound(const CellEvidence& known) {
  const auto is_index = [](int index) {
    return index >= -GridWindow::kMaxCell && index <= GridWindow::kMaxCell;
  };
  const auto is_count = [](int count) { return count >= 0 && count <= kMaxCount; };
  return is_index(known.cell.column) && is_index(known.cell.row) && is_count(known.refuted) &&
         is_count(known.believed) && std::isfinite(known.log_odds) && known.age >= 0.0F &&
         std::isfinite(known.age) && known.hits.count >= 0.0F && std::isfinite(known.hits.count) &&
         known.hits.sum.allFinite() && known.hits.squares.allFinite();
}

/// Returns the number of bytes from here to the end.
std::size_t bytesLeft(std::istream& in) {
  const auto here = in.tellg();
  const auto end = in.seekg(0, std::ios::end).tellg();
  in.seekg(here);
  return in ? static_cast<std::size_t>(end - here) : 0;
}

/// The file's header before the cells.
struct MapHeader {
  double cell_size = 0.0;
  std::size_t cells = 0;
  std::uint32_t checksum = 0;
};

MapHeader readMapHeader(std::istream& in, const std::string& file) {
  std::string format;
  std::getline(in, format);
  if (format != kMapFormat) {
    throw MapFileError(file + ": not a map of this version: expected '" + kMapFormat +
                       "' at its start, or a name that ends in .yaml for a map of map_server");
  }
  MapHeader header;
  std::string cell_size;
  std::string cells;
  std::string crc;
  in >> cell_size >> header.cell_size >> cells >> header.cells >> crc >> header.checksum;
  if (!in || in.get() != '\n' || cell_size != "cell_size" || cells != "cells" || crc != "crc32") {
    throw MapFileError(
        file + ": is truncated or modified: expected cell_size, cells and crc32 at its start");
  }
  return header;
}

/// Reads the bytes of the cells.
std::string readCells(std::istream& in, const MapHeader& header, const std::string& file) {
  const std::size_t size = bytesLeft(in);
  if (size % kMapBytesPerCell != 0 || size / kMapBytesPerCell != header.cells) {
    throw MapFileError(file + ": is truncated or modified: " + std::to_string(size) +
                       " bytes of cells, expected " + std::to_string(kMapBytesPerCell) +
                       " for each of " + std::to_string(header.cells));
  }
  if (header.cells > kMaxCells) {
    throw MapFileError(file + ": " + std::to_string(header.cells) + " cells, expected at most " +
                       std::to_string(kMaxCells));
  }
  std::string bytes(size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (checksumOf(bytes) != header.checksum) {
    throw MapFileError(file + ": was modified: its checksum is " +
                       std::to_string(checksumOf(bytes)) + ", expected " +
                       std::to_string(header.checksum));
  }
  return bytes;
}

}  // namespace

std::uint32_t checksumOf(const std::string& bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

std::string mapText(const MapEvidence& evidence) {
  const std::string bytes = bytesOf(evidence);
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << kMapFormat << "\ncell_size " << evidence.cell_size << "\ncells " << evidence.cells.size()
       << "\ncrc32 " << checksumOf(bytes) << '\n'
       << bytes;
  return text.str();
}

MapEvidence readMapText(std::istream& in, const std::string& file) {
  const MapHeader header = readMapHeader(in, file);
  const std::string bytes = readCells(in, header, file);
  MapEvidence evidence{header.cell_size, {}};
  evidence.cells.reserve(header.cells);
  WordReader words(bytes);
  for (std::size_t i = 0; i < header.cells; ++i) {
    evidence.cells.push_back(readCell(words));
    if (!isSound(evidence.cells.back())) {
      throw MapFileError(file + ": cell " + std::to_string(i) +
                         " holds invalid evidence: expected finite numbers");
    }
  }
  return evidence;
}

}  // namespace datmo
