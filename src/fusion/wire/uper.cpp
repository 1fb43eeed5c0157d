// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/wire/uper.h"

#include <vector>

#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo {

namespace {

constexpr int kOctet = 8;              // bits
constexpr std::int64_t kShort = 128;   // shorter lengths take one octet
constexpr std::int64_t kLong = 16384;  // and shorter ones than this two
constexpr std::int64_t kSmall = 64;    // smaller "small numbers" take six bits

/// Bits of an integer of 0 to `range`.
int widthOf(std::uint64_t range) {
  int width = 0;
  for (; range > 0; range >>= 1U) {
    ++width;
  }
  return width;
}

std::uint64_t rangeOf(std::int64_t min, std::int64_t max) {
  return static_cast<std::uint64_t>(max - min);
}

}  // namespace

bool Uper::present(bool own) {
  std::int64_t value = own ? 1 : 0;
  integer(value, 0, 1);
  return value == 1;
}

void Uper::skipInteger(std::int64_t min, std::int64_t max) {
  std::int64_t unused = min;
  integer(unused, min, max);
}

void Uper::skipSmallNumber() {
  if (present(false)) {
    skipOpenType();  // encoded like an open type
  } else {
    skipInteger(0, kSmall - 1);
  }
}

void Uper::skipAdditions() {
  std::int64_t count = 0;
  if (present(false)) {
    length(count);
  } else {
    integer(count, 0, kSmall - 1);
    ++count;
  }
  std::vector<bool> additions;
  for (std::int64_t i = 0; i < count; ++i) {
    additions.push_back(present(false));
  }
  for (const bool is_there : additions) {
    if (is_there) {
      skipOpenType();
    }
  }
}

void Uper::skipAddedChoice() {
  skipSmallNumber();
  skipOpenType();
}

void Uper::skipLongBits() {
  std::int64_t count = 0;
  length(count);
  for (std::int64_t i = 0; i < count; ++i) {
    present(false);
  }
}

std::int64_t Uper::extensibleSize(std::int64_t own, std::int64_t min, std::int64_t max) {
  std::int64_t size = own;
  if (extended()) {
    length(size);
  } else {
    integer(size, min, max);
  }
  return size;
}

std::uint64_t UperReader::bits(int count) {
  if (kOctet * bytes_.size() - position_ < static_cast<std::size_t>(count)) {
    throw WireError("truncated_message", "a message of " + std::to_string(bytes_.size()) +
                                             " bytes ends within a field: expected all of it");
  }
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i, ++position_) {
    const auto octet = static_cast<unsigned char>(bytes_[position_ / kOctet]);
    const auto shift = static_cast<unsigned int>(kOctet - 1 - position_ % kOctet);
    value = (value << 1U) | ((static_cast<unsigned int>(octet) >> shift) & 1U);
  }
  return value;
}

void UperReader::integer(std::int64_t& value, std::int64_t min, std::int64_t max) {
  const std::uint64_t above = bits(widthOf(rangeOf(min, max)));
  if (above > rangeOf(min, max)) {
    throw WireError("bad_message", "a field is " + std::to_string(above) + " above its minimum " +
                                       std::to_string(min) + ": expected " + std::to_string(max) +
                                       " at most");
  }
  value = min + static_cast<std::int64_t>(above);
}

void UperReader::length(std::int64_t& value) {
  if (!present(false)) {
    integer(value, 0, kShort - 1);
  } else if (!present(false)) {
    integer(value, 0, kLong - 1);
  } else {
    throw WireError("bad_message",
                    "a length of 16,384 or more: expected one that fits in a datagram");
  }
}

std::string UperReader::octets() {
  std::int64_t count = 0;
  length(count);
  std::string read;
  for (std::int64_t i = 0; i < count; ++i) {
    read.push_back(static_cast<char>(bits(kOctet)));
  }
  return read;
}

void UperReader::openType(const std::function<void(Uper&)>& content) {
  const std::string read = octets();
  UperReader inner(read);
  content(inner);
}

void UperReader::skipOpenType() { octets(); }

void UperWriter::bits(std::uint64_t value, int count) {
  for (int i = count - 1; i >= 0; --i, ++size_) {
    if (size_ % kOctet == 0) {
      bytes_.push_back('\0');
    }
    const auto bit = static_cast<unsigned int>((value >> static_cast<unsigned int>(i)) & 1U);
    const auto shift = static_cast<unsigned int>(kOctet - 1 - size_ % kOctet);
    bytes_.back() = static_cast<char>(static_cast<unsigned char>(bytes_.back()) |
                                      static_cast<unsigned char>(bit << shift));
  }
}

void UperWriter::integer(std::int64_t& value, std::int64_t min, std::int64_t max) {
  if (value < min || value > max) {
    throw WireError("bad_message", "a field of " + std::to_string(value) + ": expected " +
                                       std::to_string(min) + " to " + std::to_string(max));
  }
  bits(rangeOf(min, value), widthOf(rangeOf(min, max)));
}

void UperWriter::length(std::int64_t& value) {
  if (value < kShort) {
    present(false);
    integer(value, 0, kShort - 1);
  } else {
    present(true);
    present(false);
    integer(value, 0, kLong - 1);
  }
}

void UperWriter::openType(const std::function<void(Uper&)>& content) {
  UperWriter inner;
  content(inner);
  const std::string written = inner.bytes();
  auto count = static_cast<std::int64_t>(written.size());
  length(count);
  for (const char octet : written) {
    bits(static_cast<unsigned char>(octet), kOctet);
  }
}

std::string UperWriter::bytes() const { return bytes_.empty() ? std::string(1, '\0') : bytes_; }

}  // namespace datmo
