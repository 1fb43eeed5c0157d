// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace datmo {

/// Runs long jobs in a separate thread, always on the latest request: one job runs, at most one
/// waits. Alternatively, for output that depends on the input alone, it runs each job
/// synchronously. All functions except the work itself are called by one thread.
template <typename Job, typename Result>
class NewestWorker {
 public:
  using Work = std::function<Result(const Job&)>;

  /// `work` must not throw. `beside`: use a separate thread, which calls `prepare` first.
  NewestWorker(
      Work work, bool beside, std::function<void()> prepare = [] {})
      : work_(std::move(work)) {
    if (beside) {
      thread_ = std::thread([this, prepare = std::move(prepare)] {
        prepare();
        run();
      });
    }
  }

  /// Waits for the running job; a waiting one is discarded.
  ~NewestWorker() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ends_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  NewestWorker(const NewestWorker&) = delete;
  NewestWorker& operator=(const NewestWorker&) = delete;

  /// Returns whether another job, which had not been started, was dropped in favor of this one.
  bool start(Job job) {
    if (!thread_.joinable()) {
      done_.push_back(work_(job));
      return false;
    }
    bool drops = false;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      drops = next_.has_value();
      next_ = std::move(job);
    }
    changed_.notify_all();
    return drops;
  }

  /// Returns the results since the last call, in order.
  std::vector<Result> take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(done_, {});
  }

  /// Whether a job runs or waits.
  bool isBusy() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return next_ || busy_;
  }

  /// Blocks until no job runs or waits.
  void waitUntilIdle() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return !next_ && !busy_; });
  }

 private:
  void run() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return ends_ || next_; });
      if (ends_) {
        return;
      }
      const Job job = *std::exchange(next_, std::nullopt);
      busy_ = true;
      lock.unlock();
      Result result = work_(job);
      lock.lock();
      busy_ = false;
      done_.push_back(std::move(result));
      changed_.notify_all();
    }
  }

  Work work_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Job> next_;
  std::vector<Result> done_;
  bool busy_ = false;
  bool ends_ = false;
  std::thread thread_;  ///< last: it uses all others
};

}  // namespace datmo
