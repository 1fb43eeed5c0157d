// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/can_signal.h"

#include <cmath>
#include <cstdio>
#include <regex>

#include "datmo_fusion/common/options.h"

namespace datmo {

namespace {

constexpr unsigned kByteBits = 8;
constexpr unsigned kLongestSignal = 64;
constexpr std::uint32_t kStandardIds = 0x7FF;
constexpr std::uint32_t kExtendedIds = 0x1FFFFFFF;
constexpr std::uint64_t kExtendedBit = 0x80000000;  // of an id in a DBC file

/// Returns how many bits of a Motorola signal its first byte can hold.
unsigned firstBits(unsigned start) { return start % kByteBits + 1; }

}  // namespace

std::string toText(const CanId& id) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), id.is_extended ? "0x%08X (29 bits)" : "0x%03X",
                id.number);
  return text.data();
}

std::size_t CanSignal::bytes() const {
  if (!is_big_endian) {
    return (start + length + kByteBits - 1) / kByteBits;
  }
  const unsigned first = firstBits(start);
  const unsigned further = length > first ? (length - first + kByteBits - 1) / kByteBits : 0;
  return start / kByteBits + 1 + further;
}

std::optional<std::uint64_t> CanSignal::raw(const CanFrame& frame) const {
  if (bytes() > frame.size) {
    return std::nullopt;
  }
  std::uint64_t bits = 0;
  unsigned at = start;
  for (unsigned i = 0; i < length; ++i) {
    const std::uint64_t bit = frame.data[at / kByteBits] >> (at % kByteBits) & 1U;
    if (is_big_endian) {
      bits = bits << 1U | bit;
      at = at % kByteBits == 0 ? at + 2 * kByteBits - 1 : at - 1;  // bit 7 of the next byte
    } else {
      bits |= bit << i;
      ++at;
    }
  }
  return bits;
}

std::optional<double> CanSignal::value(const CanFrame& frame) const {
  const std::optional<std::uint64_t> bits = raw(frame);
  if (!bits) {
    return std::nullopt;
  }
  const bool is_negative = is_signed && length > 0 && (*bits >> (length - 1) & 1U) != 0;
  const std::uint64_t above = length < kLongestSignal ? ~std::uint64_t{0} << length : 0;
  const auto number = is_negative ? static_cast<double>(static_cast<std::int64_t>(*bits | above))
                                  : static_cast<double>(*bits);
  return factor * number + offset;
}

CanId canId(const std::string& name, std::uint64_t number) {
  const bool is_extended = (number & kExtendedBit) != 0 || number > kStandardIds;
  const std::uint64_t id = number & ~kExtendedBit;
  if (id > kExtendedIds) {
    throw OptionError(name + " has the id " + std::to_string(number) +
                      ": expected one of 29 bits at most");
  }
  return {static_cast<std::uint32_t>(id), is_extended};
}

CanSignal canSignal(const std::string& name, const CanId& id, const std::string& text) {
  static const std::string number =
      R"(\s*([-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)\s*)";
  static const std::regex form(R"(\s*(\d{1,3})\s*\|\s*(\d{1,2})\s*@\s*([01])\s*([-+])\s*)"
                               R"(\()" +
                               number + "," + number + R"(\)\s*(?:\[)" + number + R"(\|)" + number +
                               R"(\]\s*(?:"([^"]*)\".*|(\S*)\s*))?)");
  std::smatch part;
  if (!std::regex_match(text, part, form)) {
    throw OptionError(name + " is '" + text +
                      "': expected START|LENGTH@ORDER SIGN (FACTOR,OFFSET) [MIN|MAX] \"UNIT\", as "
                      "in a DBC file: 8|16@1+ (0.01,0) [0|250] \"km/h\"");
  }
  CanSignal signal;
  signal.id = id;
  signal.start = static_cast<unsigned>(std::stoul(part[1]));
  signal.length = static_cast<unsigned>(std::stoul(part[2]));
  signal.is_big_endian = part[3] == "0";
  signal.is_signed = part[4] == "-";
  const auto toNumber = [&](const std::ssub_match& digits) {
    try {
      return std::stod(digits);
    } catch (const std::exception&) {
      throw OptionError(name + " has '" + digits.str() + "': expected a number");
    }
  };
  signal.factor = toNumber(part[5]);
  signal.offset = toNumber(part[6]);
  signal.min = part[7].matched ? toNumber(part[7]) : 0.0;
  signal.max = part[8].matched ? toNumber(part[8]) : 0.0;
  signal.unit = part[9].matched ? part[9].str() : part[10].str();
  if (signal.length < 1 || signal.length > kLongestSignal || signal.bytes() > CanFrame::kLongest) {
    throw OptionError(name + " is '" + text + "': expected 1 to 64 bits within 64 bytes");
  }
  if (signal.factor == 0.0 || signal.min > signal.max) {
    throw OptionError(name + " is '" + text +
                      "': expected a factor that is not 0, and limits that "
                      "rise");
  }
  const double largest = std::ldexp(std::abs(signal.factor), static_cast<int>(signal.length));
  if (!std::isfinite(largest + std::abs(signal.offset))) {
    throw OptionError(name + " is '" + text +
                      "': expected a factor and an offset of finite values");
  }
  return signal;
}

}  // namespace datmo
