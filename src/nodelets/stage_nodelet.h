// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "stage_host.h"

#include <nodelet/nodelet.h>

#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage/stage_factory.h"

namespace datmo {

/// Runs any stage as a nodelet: options from the private namespace, messages via StageHost.
template <typename HostedStage>
class StageNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    const NodeletParameters parameters(getPrivateNodeHandle());
    const auto options = parameters.options<typename HostedStage::Options>();
    monitor_ = std::make_unique<StageMonitor>(getName());
    transforms_ = std::make_unique<TransformBuffer>(options.input.restart_after,
                                                    parameters.shared(), *monitor_);
    const Stopwatch watch;
    stage_ = makeStage<HostedStage>(options,
                                    {*transforms_, *monitor_, [watch] { return watch.seconds(); }});
    host_ = std::make_unique<StageHost>(getNodeHandle(), getPrivateNodeHandle(), *stage_, *monitor_,
                                        kTakesTransforms<HostedStage> ? transforms_.get() : nullptr,
                                        options.input.silence_after);
  }

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<TransformBuffer> transforms_;
  std::unique_ptr<HostedStage> stage_;
  std::unique_ptr<StageHost> host_;
};

}  // namespace datmo
