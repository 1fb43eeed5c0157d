// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "device/fake_server.h"

#include "datmo_fusion/device/cola.h"

namespace datmo::samples {

/// Contents of a scan telegram of the fake scanner.
struct SickTelegram {
  std::uint16_t counter = 1;
  std::uint32_t begun = 1000000;   ///< us
  std::uint32_t sent = 1020000;    ///< us
  std::uint32_t frequency = 2500;  ///< 0.01 Hz
  std::uint8_t state = 0;          ///< the second half of the device's status
  std::uint32_t factor = 0x3F800000;
  std::uint32_t first_angle = 0xFFF92230;  ///< -45 deg
  std::vector<std::uint32_t> ranges{1000, 0, 3, 4000};
  std::vector<std::uint32_t> intensities{10, 0, 0, 0xFE};

  /// As in the telegram listing, in either dialect.
  ColaTelegram in(ColaDialect dialect) const;
};

/// Bytes of a literal that may contain zeros.
template <std::size_t kSize>
std::string bytesOf(const char (&literal)[kSize]) {
  return {literal, kSize - 1};
}

/// How a fake scanner responds to a command in the dialect that it does not speak.
enum class OtherDialect { kRefuses, kHangsUp, kIsSilent };

/// A SICK LMS111 on loopback, according to the telegram listing: 25 turns per second, one beam
/// every half degree.
class FakeSick : public FakeServer {
 public:
  using FakeServer::FakeServer;

  /// Answers all requests that precede scans; `name`: of the model.
  void shakeHands(const std::string& name = "LMS10x_FieldEval");

  /// Returns the next command without its frame; empty if the peer has closed the connection. A
  /// command in the other dialect is not answered properly, and the next one is from another
  /// connection.
  std::string command();

  void answer(const std::string& bytes) const { send(colaFrame({dialect, bytes})); }
  void scan(const SickTelegram& telegram) const { answer(telegram.in(dialect).bytes); }

  /// Returns a healthy scanner's answer to a command.
  std::string goodAnswer(const std::string& command, const std::string& name) const;

  static constexpr double kScanTime = 0.04;  ///< s

  ColaDialect dialect = ColaDialect::kBinary;
  OtherDialect other = OtherDialect::kRefuses;

 private:
  /// In either dialect.
  ColaTelegram anyCommand();
};

}  // namespace datmo::samples
