// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <termios.h>

namespace datmo::samples {

/// A device at the other end of a serial port: a pseudo terminal.
class FakeSerial {
 public:
  FakeSerial();
  ~FakeSerial();
  FakeSerial(const FakeSerial&) = delete;
  FakeSerial& operator=(const FakeSerial&) = delete;

  const std::string& file() const { return file_; }

  void send(const std::string& bytes) const;

  /// Returns what is received up to `end`, without it. Waits until the port is opened.
  std::string receive(char end);

  speed_t speed() const;

 private:
  int master_;
  std::string file_;
  std::string received_;
};

}  // namespace datmo::samples
