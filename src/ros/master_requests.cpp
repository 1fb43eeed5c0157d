// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/master_requests.h"

#include <utility>

#include <ros/master.h>
#include <ros/this_node.h>

namespace datmo {

namespace {

using XmlRpc::XmlRpcValue;

constexpr bool kWaitForMaster = false;  // no retries, like the parameter functions of roscpp

XmlRpcValue argumentsOf(const MasterRequest& request) {
  XmlRpcValue arguments;
  arguments[0] = ros::this_node::getName();
  for (const XmlRpcValue& argument : request.arguments) {
    arguments[arguments.size()] = argument;
  }
  return arguments;
}

std::optional<XmlRpcValue> askSingly(const MasterRequest& request) {
  XmlRpcValue response;
  XmlRpcValue content;
  const bool is_answered =
      ros::master::execute(request.method, argumentsOf(request), response, content, kWaitForMaster);
  return is_answered ? std::make_optional(content) : std::nullopt;
}

/// As each method of the master answers: code, message, content.
std::optional<XmlRpcValue> contentOf(XmlRpcValue answer) {
  constexpr int kSuccess = 1;
  const bool is_answer = answer.getType() == XmlRpcValue::TypeArray && answer.size() == 3 &&
                         answer[0].getType() == XmlRpcValue::TypeInt;
  return is_answer && static_cast<int>(answer[0]) == kSuccess ? std::make_optional(answer[2])
                                                              : std::nullopt;
}

}  // namespace

std::optional<MasterAnswers> answersIn(XmlRpcValue response, int count) {
  if (response.getType() != XmlRpcValue::TypeArray || response.size() != count) {
    return std::nullopt;
  }
  MasterAnswers answers;
  for (int i = 0; i < count; ++i) {
    XmlRpcValue& wrapped = response[i];
    const bool is_answer = wrapped.getType() == XmlRpcValue::TypeArray && wrapped.size() == 1;
    if (!is_answer && wrapped.getType() != XmlRpcValue::TypeStruct) {  // the latter is a fault
      return std::nullopt;
    }
    answers.push_back(is_answer ? contentOf(wrapped[0]) : std::nullopt);
  }
  return answers;
}

MasterAnswers askMasterAtOnce(const std::vector<MasterRequest>& requests) {
  XmlRpcValue all;
  for (int i = 0; i < static_cast<int>(requests.size()); ++i) {
    const MasterRequest& request = requests[static_cast<std::size_t>(i)];
    all[0][i]["methodName"] = request.method;
    all[0][i]["params"] = argumentsOf(request);
  }
  XmlRpcValue response;
  XmlRpcValue content;
  // roscpp expects the answer of a single method, and calls this one a failure.
  ros::master::execute("system.multicall", all, response, content, kWaitForMaster);
  if (auto answers = answersIn(response, static_cast<int>(requests.size()))) {
    return std::move(*answers);
  }
  MasterAnswers answers;
  for (const MasterRequest& request : requests) {
    answers.push_back(askSingly(request));
  }
  return answers;
}

}  // namespace datmo
