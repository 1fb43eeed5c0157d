// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include <ros/callback_queue_interface.h>

#include "datmo_fusion/ros/callback_poster.h"
#include "datmo_fusion/ros/stage/stage_health.h"

namespace datmo {

/// A received message that could not be decoded.
struct DecodeError {
  std::string publisher;
  std::uint32_t sequence = 0;  ///< of its header; 0: unknown
  std::string why;
  std::uint64_t count = 1;  ///< messages, of which this is the first
};

/// The decode errors of one subscription, in the thread of its own callbacks.
///
/// roscpp decodes a message once for all subscriptions of a process to its topic: with the code of
/// one of them, in the thread of another one, and the others are only left out. An error is
/// therefore reported to all of them through their callback queues, so that a StageMonitor needs no
/// lock.
///
/// An empty message, and a corrupt latched one when another subscription is added, are decoded more
/// than once and counted each time. In a flood, further errors are counted under the publisher of
/// the last one that waits, and as lost as well.
class DecodeErrors {
 public:
  using Callback = std::function<void(const DecodeError& error)>;

  /// `topic`: resolved. `queue`: that of the subscription, which must call one callback at a time,
  /// and outlive this. `callback` is called only in its callbacks, and must not throw.
  DecodeErrors(ros::CallbackQueueInterface& queue, InputTopic topic, Callback callback);

  /// Afterward `callback` is no longer called.
  ~DecodeErrors();
  DecodeErrors(const DecodeErrors&) = delete;
  DecodeErrors& operator=(const DecodeErrors&) = delete;

  /// Calls `callback` with each new error. For the subscription's callback, before a message: an
  /// error must be known before the gap that it leaves in the sequence numbers, and the call posted
  /// by report() may be behind that message in the queue.
  void deliver();

  /// Reports an error to all subscriptions of this process to a topic. From any thread.
  static void report(const InputTopic& topic, const DecodeError& error);

 private:
  void put(const DecodeError& error);

  InputTopic topic_;
  Callback callback_;
  std::mutex mutex_;
  std::vector<DecodeError> waiting_;
  CallbackPoster poster_;  ///< last: destroyed before what its calls use
};

}  // namespace datmo
