// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace datmo {

/// The unaligned packed encoding rules of ASN.1 (ITU-T X.691, UPER), as far as our messages
/// use them. One walk over the fields of a message, in the standard's order, serves both
/// directions: a UperWriter makes bits of the fields, a UperReader sets the fields from bits.
///
/// What we do not know of a later version is passed over by a reader; a writer writes none of it.
class Uper {
 public:
  virtual ~Uper() = default;

  /// INTEGER (min..max); ENUMERATED is one from 0 on (10.5, 14.2). Throws WireError
  /// (`truncated_message`, `bad_message`).
  virtual void integer(std::int64_t& value, std::int64_t min, std::int64_t max) = 0;

  /// A type by itself, in whole octets behind their number (11.2).
  virtual void openType(const std::function<void(Uper&)>& content) = 0;

  /// Passes over an open type.
  virtual void skipOpenType() = 0;

  /// Whether something optional is there; `own`: what a writer writes.
  bool present(bool own);

  /// The marker of an extensible type: whether a reader finds an extension.
  bool extended() { return present(false); }

  /// Passes over the additions behind an extensible SEQUENCE (19.7 to 19.9).
  void skipAdditions();

  /// Passes over what an extensible CHOICE has beyond its root (23.8).
  void skipAddedChoice();

  /// Passes over a small number that may be any (11.6): the name of an ENUMERATED beyond its root.
  void skipSmallNumber();

  /// Passes over a field; a writer's has the minimum.
  void skipInteger(std::int64_t min, std::int64_t max);

  /// Passes over a BIT STRING beyond the root of its size (16.6).
  void skipLongBits();

  /// The number of elements of SEQUENCE (SIZE(min..max, ...)) OF; `own`: a writer's, in the root.
  std::int64_t extensibleSize(std::int64_t own, std::int64_t min, std::int64_t max);

 protected:
  /// A length without bounds (11.9), below 16,384.
  virtual void length(std::int64_t& value) = 0;
};

/// Reads what others wrote: never beyond the end, whatever they wrote.
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

  /// What was written, with zeros up to a whole octet; one octet at least.
  std::string bytes() const;

 protected:
  void length(std::int64_t& value) override;

 private:
  void bits(std::uint64_t value, int count);

  std::string bytes_;
  std::size_t size_ = 0;  ///< bits
};

}  // namespace datmo
