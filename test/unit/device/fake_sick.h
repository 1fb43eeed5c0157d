// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "device/fake_server.h"

#include "datmo_fusion/device/cola.h"

namespace datmo::samples {

/// What a scan of the fake scanner says, as it stands in its telegram.
struct SickTelegram {
  std::uint16_t counter = 1;
  std::uint32_t begun = 1000000;  ///< us
  std::uint32_t sent = 1020000;   ///< us
  std::uint8_t state = 0;         ///< the second half of the device's status
  std::uint32_t factor = 0x3F800000;
  std::uint32_t first_angle = 0xFFF92230;  ///< -45 deg
  std::vector<std::uint32_t> ranges{1000, 0, 3, 4000};
  std::vector<std::uint32_t> intensities{10, 0, 0, 0xFE};

  /// As the telegram listing has it, in either dialect.
  ColaTelegram in(ColaDialect dialect) const;
};

/// Bytes of a literal that may contain zeros.
template <std::size_t kSize>
std::string bytesOf(const char (&literal)[kSize]) {
  return {literal, kSize - 1};
}

/// What a fake scanner does with a command in the dialect that it does not speak.
enum class OtherDialect { kRefuses, kHangsUp, kIsSilent };

/// An LMS111 of SICK's on the loopback, as the telegram listing has it: 25 turns a second, a beam
/// each half degree.
class FakeSick : public FakeServer {
 public:
  using FakeServer::FakeServer;

  /// Answers all that is asked before scans; `name`: of the model.
  void shakeHands(const std::string& name = "LMS10x_FieldEval");

  /// The next command without its frame; empty if the other side has gone. One in the other dialect
  /// is not answered well, and the next one is that of another connection.
  std::string command();

  void answer(const std::string& bytes) const { send(colaFrame({dialect, bytes})); }
  void scan(const SickTelegram& telegram) const { answer(telegram.in(dialect).bytes); }

  /// What a scanner that is well answers to a command.
  std::string goodAnswer(const std::string& command, const std::string& name) const;

  static constexpr double kScanTime = 0.04;  ///< s

  ColaDialect dialect = ColaDialect::kBinary;
  OtherDialect other = OtherDialect::kRefuses;

 private:
  /// In whatever dialect.
  ColaTelegram anyCommand();
};

}  // namespace datmo::samples
