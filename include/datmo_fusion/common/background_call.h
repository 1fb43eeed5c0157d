// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace datmo {

/// Calls a function that may block for minutes, such as a look-up over a network, in a thread of
/// its own. Nothing waits for it longer than it wants to, not even the destructor: a call that has
/// not returned by then continues alone, and its result is discarded. So the function must own all
/// that it uses. What remains: if the process exits before the call returns, it is cut off there.
///
/// At most one call runs. All functions except the call itself are for one thread.
template <typename Result>
class BackgroundCall {
 public:
  /// `call` must not throw.
  explicit BackgroundCall(std::function<Result()> call)
      : shared_(std::make_shared<Shared>(std::move(call))) {}
  BackgroundCall(const BackgroundCall&) = delete;
  BackgroundCall& operator=(const BackgroundCall&) = delete;

  /// Starts a call. Returns false if one runs already, or the system has no thread to spare.
  bool start() {
    {
      const std::lock_guard<std::mutex> lock(shared_->mutex);
      if (std::exchange(shared_->runs, true)) {
        return false;
      }
    }
    try {
      std::thread([shared = shared_] { run(*shared); }).detach();
    } catch (const std::exception&) {  // no thread, or out of memory
      const std::lock_guard<std::mutex> lock(shared_->mutex);
      shared_->runs = false;
      return false;
    }
    return true;
  }

  /// Blocks until no call runs, at most for `patience`. Returns whether none does.
  bool waitFor(std::chrono::milliseconds patience) {
    std::unique_lock<std::mutex> lock(shared_->mutex);
    return shared_->ended.wait_for(lock, patience, [this] { return !shared_->runs; });
  }

  /// Returns the result of the last call, once; none if none has returned since the last time.
  std::optional<Result> take() {
    const std::lock_guard<std::mutex> lock(shared_->mutex);
    return std::exchange(shared_->result, std::nullopt);
  }

 private:
  struct Shared {
    explicit Shared(std::function<Result()> what) : call(std::move(what)) {}

    std::function<Result()> call;
    std::mutex mutex;
    std::condition_variable ended;
    std::optional<Result> result;  ///< none, or taken
    bool runs = false;
  };

  static void run(Shared& shared) {
    Result result = shared.call();
    {
      const std::lock_guard<std::mutex> lock(shared.mutex);
      shared.result = std::move(result);
      shared.runs = false;
    }
    shared.ended.notify_all();
  }

  std::shared_ptr<Shared> shared_;
};

}  // namespace datmo
