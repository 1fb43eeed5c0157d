// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <XmlRpcValue.h>

namespace datmo {

/// A request to the master; `arguments`: those after the caller's name.
struct MasterRequest {
  std::string method;
  std::vector<XmlRpc::XmlRpcValue> arguments;
};

/// The content of each answer; none if the master refuses the request (an unset parameter).
using MasterAnswers = std::vector<std::optional<XmlRpc::XmlRpcValue>>;

/// Sends all requests at once: on a slow network each one on its own would take a round trip, and
/// roscpp sends its own ones one after the other. A master that only takes single requests gets
/// them singly.
MasterAnswers askMasterAtOnce(const std::vector<MasterRequest>& requests);

/// Returns the answers in the response to `count` requests that were sent at once; none if it is no
/// such response.
std::optional<MasterAnswers> answersIn(XmlRpc::XmlRpcValue response, int count);

}  // namespace datmo
