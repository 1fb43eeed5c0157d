// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "device/fake_server.h"

namespace datmo::samples {

/// What a scan of the fake scanner says, as it stands in its telegram.
struct SickTelegram {
  std::uint16_t counter = 1;
  std::uint32_t begun = 1000000;  ///< us
  std::uint32_t sent = 1020000;   ///< us
  std::string state = "0 0";
  std::string factor = "3F800000";
  std::string first_angle = "FFF92230";  ///< -45 deg
  std::vector<std::uint32_t> ranges{1000, 0, 3, 4000};
  std::vector<std::uint32_t> intensities{10, 0, 0, 0xFE};

  /// Between its control characters.
  std::string text() const;
};

/// An LMS111 of SICK's on the loopback, as the telegram listing has it: 25 turns a second, a beam
/// each half degree.
class FakeSick : public FakeServer {
 public:
  using FakeServer::FakeServer;

  /// Answers all that is asked before scans; `name`: of the model.
  void shakeHands(const std::string& name = "LMS10x_FieldEval");

  /// The next command without its control characters; empty if the other side has gone.
  std::string command();

  void answer(const std::string& text) const;
  void scan(const SickTelegram& telegram) const { answer(telegram.text()); }

  /// What a scanner that is well answers to a command.
  static std::string goodAnswer(const std::string& command, const std::string& name);

  static constexpr double kScanTime = 0.04;  ///< s
};

}  // namespace datmo::samples
