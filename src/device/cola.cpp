// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/cola.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace datmo {

namespace {

constexpr char kStart = '\x02';
constexpr char kEnd = '\x03';
constexpr std::string_view kBinaryStart = "\x02\x02\x02\x02";
constexpr std::size_t kLengthSize = 4;
constexpr std::size_t kColaByteBits = 8;

/// The longest telegram: five echoes and their remission in 1,141 beams, six characters each.
constexpr std::size_t kLongestTelegram = 131072;

DeviceError endsBefore(const char* name) {
  return badAnswer(std::string("a telegram that ends before ") + name +
                   ": expected a complete one");
}

DeviceError wrongDialect(ColaDialect expected) {
  return {kWrongDialect, std::string("the scanner speaks ") + nameOf(otherThan(expected)) +
                             ": expected " + nameOf(expected) + ", in which it was asked"};
}

std::uint32_t numberOf(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes) {
    value = value << kColaByteBits | static_cast<unsigned char>(byte);
  }
  return value;
}

std::string bytesOf(std::uint32_t value, std::size_t size) {
  std::string bytes(size, '\0');
  for (auto byte = bytes.rbegin(); byte != bytes.rend(); ++byte) {
    *byte = static_cast<char>(value & std::numeric_limits<unsigned char>::max());
    value >>= kColaByteBits;
  }
  return bytes;
}

std::uint32_t numberOfWord(std::string_view word, const char* name) {
  constexpr int kHexadecimal = 16;
  constexpr int kDecimal = 10;
  const bool has_sign = word[0] == '+' || word[0] == '-';
  const char* const first = word.data() + (word[0] == '+' ? 1 : 0);
  const char* const last = word.data() + word.size();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(first, last, value, has_sign ? kDecimal : kHexadecimal);
  if (error != std::errc() || end != last || value < std::numeric_limits<std::int32_t>::min() ||
      value > std::numeric_limits<std::uint32_t>::max()) {
    throw badAnswer(shownBytes(word) + " as " + name + ": expected a number of 32 bits");
  }
  return static_cast<std::uint32_t>(value);
}

char checksumOf(std::string_view bytes) {
  char sum = 0;
  for (const char byte : bytes) {
    sum = static_cast<char>(sum ^ byte);
  }
  return sum;
}

/// Returns the length of a telegram's name, which is two words.
std::size_t nameLength(std::string_view telegram) {
  const std::size_t kind = telegram.find(' ');
  return kind == std::string_view::npos ? telegram.size()
                                        : std::min(telegram.find(' ', kind + 1), telegram.size());
}

}  // namespace

DeviceError badAnswer(const std::string& text) { return {"bad_answer", text}; }

const char* nameOf(ColaDialect dialect) {
  return dialect == ColaDialect::kBinary ? "CoLa B" : "CoLa A";
}

ColaDialect otherThan(ColaDialect dialect) {
  return dialect == ColaDialect::kBinary ? ColaDialect::kText : ColaDialect::kBinary;
}

bool ColaTelegram::isCalled(std::string_view name) const {
  return std::string_view(bytes).substr(0, nameLength(bytes)) == name;
}

ColaTelegram colaCommand(ColaDialect dialect, std::string_view name,
                         const std::vector<ColaParameter>& parameters) {
  ColaTelegram telegram{dialect, std::string(name)};
  const bool is_binary = dialect == ColaDialect::kBinary;
  if (is_binary && !parameters.empty()) {
    telegram.bytes += ' ';
  }
  for (const ColaParameter& parameter : parameters) {
    telegram.bytes += is_binary
                          ? bytesOf(numberOfWord(parameter.text, "a parameter"), parameter.size)
                          : ' ' + std::string(parameter.text);
  }
  return telegram;
}

std::string colaFrame(const ColaTelegram& telegram) {
  if (telegram.dialect == ColaDialect::kText) {
    return kStart + telegram.bytes + kEnd;
  }
  const auto length = static_cast<std::uint32_t>(telegram.bytes.size());
  return std::string(kBinaryStart) + bytesOf(length, kLengthSize) + telegram.bytes +
         checksumOf(telegram.bytes);
}

std::optional<ColaTelegram> ColaReader::next() {
  return dialect_ == ColaDialect::kBinary ? nextBinary() : nextText();
}

std::optional<ColaTelegram> ColaReader::nextBinary() {
  constexpr std::size_t kHead = kBinaryStart.size() + kLengthSize;
  const std::string_view waiting = waiting_;
  const std::size_t known = std::min(waiting.size(), kBinaryStart.size());
  if (waiting.substr(0, known) != kBinaryStart.substr(0, known)) {
    if (waiting[0] == kStart) {
      throw wrongDialect(dialect_);
    }
    throw badAnswer(shownBytes(waiting) + ": expected a telegram of CoLa B, which begins with STX");
  }
  if (waiting.size() < kHead) {
    return std::nullopt;
  }
  const std::size_t length = numberOf(waiting.substr(kBinaryStart.size(), kLengthSize));
  if (length > kLongestTelegram) {
    throw badAnswer("a telegram of " + std::to_string(length) + " bytes: expected at most " +
                    std::to_string(kLongestTelegram));
  }
  if (waiting.size() < kHead + length + 1) {
    return std::nullopt;
  }
  ColaTelegram telegram{dialect_, std::string(waiting.substr(kHead, length))};
  if (checksumOf(telegram.bytes) != waiting[kHead + length]) {
    throw badAnswer(shownBytes(telegram.bytes) + " with a wrong checksum: expected that of CoLa B");
  }
  waiting_.erase(0, kHead + length + 1);
  return telegram;
}

std::optional<ColaTelegram> ColaReader::nextText() {
  if (waiting_.rfind(kBinaryStart, 0) == 0) {
    throw wrongDialect(dialect_);
  }
  const std::size_t end = waiting_.find(kEnd);
  if (end == std::string::npos) {
    if (waiting_.size() > kLongestTelegram) {
      throw badAnswer(shownBytes(waiting_) + " and so on: expected a telegram's end within " +
                      std::to_string(kLongestTelegram) + " bytes");
    }
    return std::nullopt;
  }
  // The last start: any telegram before it is incomplete.
  const std::size_t start = waiting_.rfind(kStart, end);
  if (start == std::string::npos) {
    throw badAnswer(shownBytes(waiting_) +
                    ": expected a telegram of CoLa A, which begins with STX");
  }
  ColaTelegram telegram{dialect_, waiting_.substr(start + 1, end - start - 1)};
  waiting_.erase(0, end + 1);
  return telegram;
}

ColaFields::ColaFields(const ColaTelegram& telegram)
    : dialect_(telegram.dialect), rest_(telegram.bytes) {
  rest_.remove_prefix(nameLength(rest_));
  if (dialect_ == ColaDialect::kBinary && !rest_.empty()) {
    rest_.remove_prefix(1);  // the space between the name and the fields
  }
}

std::string_view ColaFields::take(std::size_t count, const char* name) {
  if (rest_.size() < count) {
    throw endsBefore(name);
  }
  const std::string_view taken = rest_.substr(0, count);
  rest_.remove_prefix(count);
  return taken;
}

std::string_view ColaFields::word(const char* name) {
  rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size()));
  if (rest_.empty()) {
    throw endsBefore(name);
  }
  return take(std::min(rest_.find(' '), rest_.size()), name);
}

void ColaFields::skip(std::size_t size, const char* name) {
  dialect_ == ColaDialect::kBinary ? take(size, name) : word(name);
}

std::uint32_t ColaFields::number(std::size_t size, const char* name) {
  return dialect_ == ColaDialect::kBinary ? numberOf(take(size, name))
                                          : numberOfWord(word(name), name);
}

std::int32_t ColaFields::signedNumber(const char* name) {
  return static_cast<std::int32_t>(number(sizeof(std::int32_t), name));
}

float ColaFields::real(const char* name) {
  const std::uint32_t bits = number(sizeof(float), name);
  float value = 0.0F;
  static_assert(sizeof value == sizeof bits);
  std::memcpy(&value, &bits, sizeof value);
  if (!std::isfinite(value)) {
    throw badAnswer(std::string(name) + " is not finite: expected a number");
  }
  return value;
}

std::string_view ColaFields::characters(std::size_t count, const char* name) {
  if (dialect_ == ColaDialect::kText) {
    take(1, name);  // the space before them
  }
  return take(count, name);
}

void ColaFields::require(std::size_t count, std::size_t size, const char* name) const {
  constexpr std::size_t kShortestWord = 2;  // a space and a digit
  if (count > rest_.size() / (dialect_ == ColaDialect::kBinary ? size : kShortestWord)) {
    throw endsBefore(name);
  }
}

}  // namespace datmo
