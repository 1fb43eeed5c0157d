// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace datmo::samples {

/// A loopback port that nobody listens on, nor can as long as this object exists: a closed port may
/// be another process's the next moment.
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

/// The peer of a device with TCP on loopback. It does what the test says, in the test's own thread;
/// nothing sleeps.
class FakeServer {
 public:
  /// Port 0: any that is free.
  explicit FakeServer(int port = 0);
  ~FakeServer();
  FakeServer(const FakeServer&) = delete;
  FakeServer& operator=(const FakeServer&) = delete;

  int port() const { return port_; }

  /// Waits for the next connection.
  void accept();

  /// Returns what is received up to `end`, without it; empty if the peer has closed the connection.
  std::string receive(char end);

  /// Returns the next `count` bytes; empty if the peer has closed the connection.
  std::string receiveBytes(std::size_t count);

  void send(const std::string& bytes) const;

  /// Closes the connection.
  void close();

 private:
  /// Waits for more; returns false if the peer has closed the connection.
  bool receiveMore();

  int listener_ = -1;
  int client_ = -1;
  int port_ = 0;
  std::string received_;
};

}  // namespace datmo::samples
