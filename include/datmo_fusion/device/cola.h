// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "datmo_fusion/device/device_error.h"

namespace datmo {

/// The dialects of CoLa, the command language of SICK's sensors (SICK, Telegram listing LMS1xx,
/// LMS5xx, TiM5xx, TiM7xx, 8014631, 2020, sections 2.1 to 2.3).
enum class ColaDialect {
  kBinary,  ///< CoLa B: four STX, length, name, big-endian fields, XOR checksum
  kText     ///< CoLa A: STX, name, fields as words, ETX
};

/// Returns "CoLa B" or "CoLa A".
const char* nameOf(ColaDialect dialect);

ColaDialect otherThan(ColaDialect dialect);

/// The reason of a DeviceError: bytes of the other dialect were received.
inline constexpr const char* kWrongDialect = "wrong_dialect";

/// Returns the error for invalid bytes or an invalid telegram (`bad_answer`).
DeviceError badAnswer(const std::string& text);

/// A telegram without its frame: its name, which is the same in both dialects, and its fields.
struct ColaTelegram {
  ColaDialect dialect = ColaDialect::kBinary;
  std::string bytes;

  /// Returns whether this is its name: "sSN LMDscandata".
  bool isCalled(std::string_view name) const;
};

/// A field of a command: as CoLa A writes it, and its bytes in CoLa B.
struct ColaParameter {
  std::string_view text;
  std::size_t size = 1;
};

/// Throws DeviceError (`bad_answer`) for a parameter that is not a number.
ColaTelegram colaCommand(ColaDialect dialect, std::string_view name,
                         const std::vector<ColaParameter>& parameters = {});

/// Returns the telegram as it is sent.
std::string colaFrame(const ColaTelegram& telegram);

/// Splits the bytes of a connection into telegrams of one dialect.
class ColaReader {
 public:
  explicit ColaReader(ColaDialect dialect) : dialect_(dialect) {}

  void feed(std::string_view bytes) { waiting_ += bytes; }

  /// Returns the next complete telegram; none if it has not arrived yet. Throws DeviceError:
  /// `wrong_dialect` for the other dialect, `bad_answer` for bytes that are not a telegram, for one
  /// that is too long and for a wrong checksum.
  std::optional<ColaTelegram> next();

 private:
  std::optional<ColaTelegram> nextBinary();
  std::optional<ColaTelegram> nextText();

  ColaDialect dialect_;
  std::string waiting_;
};

/// Reads the fields of a telegram, from the first one on. `name`: of a field, for messages. All
/// functions throw DeviceError (`bad_answer`) if the telegram ends before the field.
class ColaFields {
 public:
  /// `telegram` must outlive it.
  explicit ColaFields(const ColaTelegram& telegram);

  /// Skips a field of `size` bytes in CoLa B.
  void skip(std::size_t size, const char* name);

  /// Reads an unsigned number of `size` bytes (1 to 4) in CoLa B; in CoLa A hexadecimal, or decimal
  /// after a sign. Throws DeviceError (`bad_answer`) unless it is a number of 32 bits.
  std::uint32_t number(std::size_t size, const char* name);

  /// Reads a two's complement of 4 bytes: FFF92230 is -450000.
  std::int32_t signedNumber(const char* name);

  /// Reads a float of 4 bytes (IEEE 754): 3F800000 is 1. Throws DeviceError (`bad_answer`) unless
  /// finite.
  float real(const char* name);

  /// Reads `count` characters, including spaces.
  std::string_view characters(std::size_t count, const char* name);

  /// Throws DeviceError (`bad_answer`) unless there can be `count` fields of `size` bytes: to be
  /// called before memory is allocated for them.
  void require(std::size_t count, std::size_t size, const char* name) const;

 private:
  std::string_view word(const char* name);
  std::string_view take(std::size_t count, const char* name);

  ColaDialect dialect_;
  std::string_view rest_;
};

}  // namespace datmo
