// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include <boost/make_shared.hpp>

#include <ros/callback_queue_interface.h>
#include <ros/node_handle.h>

namespace datmo {

/// Calls a function in the callback queue of a nodelet, rung from any thread. When it is gone, it
/// has been called for the last time: who rings ends before it.
class CallbackBell {
 public:
  CallbackBell(const ros::NodeHandle& node, std::function<void()> serve)
      : queue_(*node.getCallbackQueue()), serve_(std::move(serve)) {}
  ~CallbackBell() { queue_.removeByID(id()); }
  CallbackBell(const CallbackBell&) = delete;
  CallbackBell& operator=(const CallbackBell&) = delete;

  void ring() { queue_.addCallback(boost::make_shared<Call>(serve_), id()); }

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
