// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/published_topics.h"

#include <exception>
#include <utility>

#include <xmlrpcpp/XmlRpcException.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <ros/master.h>
#include <ros/this_node.h>

namespace datmo {

namespace {

/// At the end, where a query that goes on while the process exits uses what is gone.
constexpr std::chrono::milliseconds kQueryPatienceAtEnd(1000);

}  // namespace

std::optional<TopicTypes> queryPublishedTopics() {
  try {
    XmlRpc::XmlRpcValue request;
    XmlRpc::XmlRpcValue response;
    XmlRpc::XmlRpcValue topics;
    request[0] = ros::this_node::getName();
    request[1] = "";
    constexpr bool kWaitForMaster = false;  // no retries
    if (!ros::master::execute("getPublishedTopics", request, response, topics, kWaitForMaster)) {
      return std::nullopt;
    }
    TopicTypes types;
    for (int i = 0; i < topics.size(); ++i) {
      types.emplace(std::string(topics[i][0]), std::string(topics[i][1]));
    }
    return types;
  } catch (const XmlRpc::XmlRpcException&) {  // an answer of another form
    return std::nullopt;
  } catch (const std::exception&) {  // out of memory
    return std::nullopt;
  }
}

PublishedTopics::PublishedTopics(Query query) : query_(std::move(query)) {}

PublishedTopics::~PublishedTopics() { query_.waitFor(kQueryPatienceAtEnd); }

void PublishedTopics::update(std::chrono::milliseconds patience) {
  if (!query_.waitFor(std::chrono::milliseconds::zero())) {
    return;
  }
  keepAnswer();  // before that of the next query, which may be none, replaces it
  if (query_.start() && query_.waitFor(patience)) {
    keepAnswer();
  }
}

void PublishedTopics::keepAnswer() {
  if (auto answer = query_.take(); answer && *answer) {
    types_ = std::move(*answer);
  }
}

std::optional<std::string> PublishedTopics::typeOf(const std::string& topic) const {
  if (!types_) {
    return std::nullopt;
  }
  const auto found = types_->find(topic);
  return found == types_->end() ? "" : found->second;
}

}  // namespace datmo
