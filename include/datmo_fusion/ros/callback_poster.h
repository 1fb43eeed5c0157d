// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include <boost/make_shared.hpp>

#include <ros/callback_queue_interface.h>

namespace datmo {

/// Posts calls of a function to a callback queue (of a nodelet), from any thread. After its
/// destruction the function is no longer called; the posting threads must have stopped before.
class CallbackPoster {
 public:
  /// `queue` must outlive it; `serve` must not throw.
  CallbackPoster(ros::CallbackQueueInterface& queue, std::function<void()> serve)
      : queue_(queue), serve_(std::move(serve)) {}
  ~CallbackPoster() { queue_.removeByID(id()); }
  CallbackPoster(const CallbackPoster&) = delete;
  CallbackPoster& operator=(const CallbackPoster&) = delete;

  void post() { queue_.addCallback(boost::make_shared<Call>(serve_), id()); }

 private:
  class Call : public ros::CallbackInterface {
   public:
    explicit Call(const std::function<void()>& serve) : serve_(serve) {}
    CallResult call() override {
      serve_();
      return Success;
    }

   private:
    const std::function<void()>& serve_;
  };

  std::uint64_t id() const { return reinterpret_cast<std::uint64_t>(this); }

  ros::CallbackQueueInterface& queue_;
  std::function<void()> serve_;
};

}  // namespace datmo
