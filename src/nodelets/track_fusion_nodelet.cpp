#include <memory>
#include <string>

#include "choice_server.h"
#include "source_fusion_nodelet.h"
#include <datmo_fusion/TrackFusionConfig.h>

#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/track_fusion_stage.h"

namespace datmo {

/// The door to TrackFusionStage. In: tracks/<source> of each source. Out: tracks/fused. Which
/// tracks come out may be changed by dynamic_reconfigure.
class TrackFusionNodelet
    : public SourceFusionNodelet<TrackFusionStage, TrackFusionStageOptions, TrackArray> {
 public:
  TrackFusionNodelet() : SourceFusionNodelet("tracks") {}

 private:
  using Config = datmo_fusion::TrackFusionConfig;

  void prepare(const TrackFusionStageOptions& options) override {
    fused_ = getNodeHandle().advertise<TrackArray>("tracks/fused", kQueue);
    scheme_ = std::make_unique<ChoiceServer<Config>>(
        getPrivateNodeHandle(), &Config::scheme, options.fuser.scheme,
        [this](const std::string& scheme) { stage().setScheme(scheme); });
  }

  void take(const std::string& source, const TrackArray& message, Stamp now) override {
    stage().takeTracks(source, message, now);
  }

  bool publishNext(Stamp now) override {
    const auto tracks = stage().next(now);
    if (tracks) {
      fused_.publish(tracks);
    }
    return tracks != nullptr;
  }

  std::unique_ptr<ChoiceServer<Config>> scheme_;
  ros::Publisher fused_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::TrackFusionNodelet, nodelet::Nodelet)
