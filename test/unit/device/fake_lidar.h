// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace datmo::samples {

/// Sends datagrams to a port of loopback.
class FakeLidar {
 public:
  explicit FakeLidar(int port);
  ~FakeLidar();
  FakeLidar(const FakeLidar&) = delete;
  FakeLidar& operator=(const FakeLidar&) = delete;

  void send(const std::string& bytes) const;

  /// Returns a UDP port that nobody listens to at present.
  static int freePort();

 private:
  int socket_ = -1;
};

}  // namespace datmo::samples
