// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace datmo {

/// The unaligned packed encoding rules of ASN.1 (ITU-T X.691, UPER), as far as our messages use
/// them. One walk over the fields of a message, in the standard's order, serves both directions: a
/// UperWriter encodes the fields, a UperReader decodes them.
///
/// A reader skips unknown parts of later versions; a writer writes none.
class Uper {
 public:
  virtual ~Uper() = default;

  /// INTEGER (min..max); an ENUMERATED is encoded as one from 0 on (10.5, 14.2). Throws WireError
  /// (`truncated_message`, `bad_message`).
  virtual void integer(std::int64_t& value, std::int64_t min, std::int64_t max) = 0;

  /// An open type: whole octets, preceded by their number (11.2).
  virtual void openType(const std::function<void(Uper&)>& content) = 0;

  /// Skips an open type.
  virtual void skipOpenType() = 0;

  /// Whether an optional field is present; `own`: what a writer writes.
  bool present(bool own);

  /// The extension marker of an extensible type: whether a reader finds an extension.
  bool extended() { return present(false); }

  /// Skips the additions of an extensible SEQUENCE (19.7 to 19.9).
  void skipAdditions();

  /// Skips an alternative beyond the root of an extensible CHOICE (23.8).
  void skipAddedChoice();

  /// Skips an unbounded small number (11.6): an ENUMERATED value beyond the root.
  void skipSmallNumber();

  /// Skips a field; a writer writes the minimum.
  void skipInteger(std::int64_t min, std::int64_t max);

  /// Skips a BIT STRING beyond the root of its size (16.6).
  void skipLongBits();

  /// The number of elements of SEQUENCE (SIZE(min..max, ...)) OF; `own`: the writer's, in the root.
  std::int64_t extensibleSize(std::int64_t own, std::int64_t min, std::int64_t max);

 protected:
  /// An unbounded length (11.9), below 16,384.
  virtual void length(std::int64_t& value) = 0;
};

/// Decodes bytes from others; never reads beyond the end, whatever they contain.
class UperReader : public Uper {
 public:
  /// The bytes must outlive it.
  explicit UperReader(std::string_view bytes) : bytes_(bytes) {}

  void integer(std::int64_t& value, std::int64_t min, std::int64_t max) override;
  void openType(const std::function<void(Uper&)>& content) override;
  void skipOpenType() override;

 protected:
  void length(std::int64_t& value) override;

 private:
  std::uint64_t bits(int count);
  std::string octets();

  std::string_view bytes_;
  std::size_t position_ = 0;  ///< of the next bit
};

class UperWriter : public Uper {
 public:
  void integer(std::int64_t& value, std::int64_t min, std::int64_t max) override;
  void openType(const std::function<void(Uper&)>& content) override;
  void skipOpenType() override {}

  /// Returns what was written, padded with zeros to whole octets; at least one octet.
  std::string bytes() const;

 protected:
  void length(std::int64_t& value) override;

 private:
  void bits(std::uint64_t value, int count);

  std::string bytes_;
  std::size_t size_ = 0;  ///< bits
};

}  // namespace datmo
