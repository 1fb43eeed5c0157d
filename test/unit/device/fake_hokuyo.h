// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "device/fake_server.h"

namespace datmo::samples {

/// A Hokuyo scanner on loopback, according to its manual: 90 degrees ahead in 5 beams, 40 turns per
/// second.
class FakeHokuyo : public FakeServer {
 public:
  using FakeServer::FakeServer;

  /// Answers all requests that precede scans; `model`: answer to PP, without a status.
  void shakeHands(const std::vector<std::string>& model = kModel);

  /// Returns the next command, without its end; empty if the peer has closed the connection.
  std::string command() { return receive('\n'); }

  void answer(const std::string& command, const std::string& status,
              const std::vector<std::string>& lines = {}) {
    send(answerText(command, status, lines));
  }

  static std::string answerText(const std::string& command, const std::string& status,
                                const std::vector<std::string>& lines = {});

  /// Returns a scan's message: `clock` in ms, 24 bits; ranges in mm, one per beam.
  static std::string scan(std::uint32_t clock, const std::vector<std::uint32_t>& ranges);

  static const std::vector<std::string> kModel;
  static constexpr std::size_t kBeams = 5;
  static constexpr double kScanTime = 0.025;  ///< s
  /// s, from a scan's first beam to its last.
  static constexpr double kSweep = 4.0 * kScanTime / 16.0;
  static constexpr double kBeamSpacing = 0.39269908;  ///< rad
};

}  // namespace datmo::samples
