// SPDX-License-Identifier: BSD-3-Clause
#include "live_server.h"

#include <utility>

#include <ros/console.h>

#include "datmo_fusion/ros/convert/live_option_conversion.h"
#include "datmo_fusion/ros/master_requests.h"
#include "datmo_fusion/ros/stage/guard.h"

namespace datmo {

namespace {

using XmlRpc::XmlRpcValue;

constexpr char kService[] = "set_parameters";

XmlRpcValue xmlRpcOf(const std::vector<double>& numbers) {
  XmlRpcValue list;
  list.setSize(0);  // an array, also if it stays empty
  for (const double number : numbers) {
    list[list.size()] = number;
  }
  return list;
}

template <typename Value>
XmlRpcValue xmlRpcOf(const Value& value) {
  return XmlRpcValue(value);
}

XmlRpcValue xmlRpcOf(const OptionValue& option) {
  return std::visit([](const auto& value) { return xmlRpcOf(value); }, option);
}

}  // namespace

LiveServer::LiveServer(ros::NodeHandle node, StageMonitor& monitor, Present present, Change change)
    : node_(std::move(node)),
      monitor_(monitor),
      present_(std::move(present)),
      change_(std::move(change)) {
  descriptions_ =
      node_.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, true);
  updates_ = node_.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, true);
  descriptions_.publish(descriptionOf(present_()));
  publish(present_());
  service_ = node_.advertiseService(kService, &LiveServer::setParameters, this);
}

bool LiveServer::setParameters(dynamic_reconfigure::Reconfigure::Request& request,
                               dynamic_reconfigure::Reconfigure::Response& response) {
  guarded(monitor_, kService, [&] {
    try {
      change_(valuesOf(request.config));
    } catch (const OptionError& error) {
      ROS_ERROR("%s: %s; keeps the previous values", node_.getNamespace().c_str(), error.what());
    }
  });
  bool answered = false;
  guarded(monitor_, kService, [&] {
    const std::vector<LiveOption> options = present_();
    response.config = configOf(options);
    publish(options);
    answered = true;
  });
  return answered;
}

void LiveServer::publish(const std::vector<LiveOption>& options) {
  std::vector<MasterRequest> requests;
  for (const LiveOption& option : options) {
    requests.push_back(
        {"setParam", {XmlRpcValue(node_.resolveName(option.key)), xmlRpcOf(option.value)}});
  }
  askMasterAtOnce(requests);
  updates_.publish(configOf(options));
}

}  // namespace datmo
