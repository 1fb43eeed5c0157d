// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "datmo_fusion/common/background_call.h"

namespace datmo {

using TopicTypes = std::map<std::string, std::string>;  ///< by topic

/// Returns the published topics with their types; none if the master does not answer. May block for
/// minutes.
std::optional<TopicTypes> queryPublishedTopics();

/// The published topics by the master's last answer. The master is queried in a thread of its own:
/// if its computer cannot be reached, that takes minutes, and neither a stage nor a window may wait
/// for it. All functions are for one thread.
class PublishedTopics {
 public:
  using Query = std::function<std::optional<TopicTypes>()>;

  /// `query` must not throw.
  explicit PublishedTopics(Query query = queryPublishedTopics);

  /// Waits for a query that is quick.
  ~PublishedTopics();
  PublishedTopics(const PublishedTopics&) = delete;
  PublishedTopics& operator=(const PublishedTopics&) = delete;

  /// Starts a query unless one runs, and waits for it, at most for `patience`; an answer that comes
  /// later counts from the next update on. An earlier answer stays if the master gives none.
  void update(std::chrono::milliseconds patience);

  /// Returns the type of a topic; empty: not published; none: the master has not answered yet.
  std::optional<std::string> typeOf(const std::string& topic) const;

 private:
  void keepAnswer();

  BackgroundCall<std::optional<TopicTypes>> query_;
  std::optional<TopicTypes> types_;
};

}  // namespace datmo
