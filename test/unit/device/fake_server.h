// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace datmo::samples {

/// A port of the loopback that nobody listens on, nor can as long as this is there: one that was
/// closed may be another process's the next moment.
class UnusedPort {
 public:
  UnusedPort();
  ~UnusedPort();
  UnusedPort(const UnusedPort&) = delete;
  UnusedPort& operator=(const UnusedPort&) = delete;

  int port() const { return port_; }

 private:
  int socket_;
  int port_;
};

/// The loopback's side of a device with TCP. It does what the test says, in the test's own thread;
/// nothing sleeps.
class FakeServer {
 public:
  /// Port 0: any that is free.
  explicit FakeServer(int port = 0);
  ~FakeServer();
  FakeServer(const FakeServer&) = delete;
  FakeServer& operator=(const FakeServer&) = delete;

  int port() const { return port_; }

  /// The next one that connects.
  void accept();

  /// What comes up to `end`, without it; empty if the other side has gone.
  std::string receive(char end);

  /// The next `count` bytes; empty if the other side has gone.
  std::string receiveBytes(std::size_t count);

  void send(const std::string& bytes) const;

  /// Hangs up.
  void close();

 private:
  /// Waits for more; false if the other side has gone.
  bool receiveMore();

  int listener_ = -1;
  int client_ = -1;
  int port_ = 0;
  std::string received_;
};

}  // namespace datmo::samples
