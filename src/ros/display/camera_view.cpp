// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/camera_view.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "track_drawing.h"

#include "datmo_fusion/ros/convert/image_conversion.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

/// Two seconds of a fast scanner's tracks; one second of a camera's images.
constexpr std::size_t kMaxTrackLists = 50;
constexpr std::size_t kMaxImages = 30;

/// Pose of a frame in another one at a time. Throws InputError (`missing_transform`).
Eigen::Isometry3d poseAt(const tf2::BufferCore& transforms, const std::string& parent,
                         const std::string& child, const ros::Time& time) {
  try {
    const auto transform = transforms.lookupTransform(parent, child, time).transform;
    const auto& q = transform.rotation;
    const auto& t = transform.translation;
    Eigen::Isometry3d pose(Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized());
    pose.translation() = Eigen::Vector3d(t.x, t.y, t.z);
    return pose;
  } catch (const std::runtime_error& error) {  // from tf2, and from ros::Time near its end
    throw InputError("missing_transform", "transform " + parent + " -> " + child +
                                              ": expected on tf (" + error.what() + ")");
  }
}

}  // namespace

CameraView::CameraView(const Checked<CameraViewOptions>& options, const TransformBuffer& transforms,
                       StageMonitor& monitor)
    : options_(*options),
      transforms_(transforms),
      monitor_(monitor),
      runner_(monitor, options->input, "forgets all images", [this] {
        queue_.clear();
        tracks_.clear();
      }) {}

void CameraView::handleCameraInfo(const sensor_msgs::CameraInfo& message) {
  runner_.serve([&] { camera_.update(message); });
}

void CameraView::handleTracks(const TrackArrayConstPtr& message) {
  runner_.serve([&] {
    runner_.check("tracks", message->header.stamp);
    tracks_.push_back(message);
    if (tracks_.size() > kMaxTrackLists) {
      tracks_.pop_front();
    }
  });
}

void CameraView::handleImage(const sensor_msgs::ImageConstPtr& message, Stamp now) {
  runner_.serve([&] {
    runner_.check("image", message->header.stamp);
    camera_.check(*message);
    if (queue_.size() >= kMaxImages) {
      queue_.pop_front();
      monitor_.dropped(InputError("queue_full", "more than " + std::to_string(kMaxImages) +
                                                    " images wait: dropped the oldest"));
    }
    queue_.push_back({message, now});
  });
}

sensor_msgs::ImagePtr CameraView::next(Stamp now) {
  while (!queue_.empty()) {
    const Waiting waiting = queue_.front();
    const bool last_chance = hasWaitedTooLong(waiting, now);
    try {
      auto drawn = draw(waiting.image, !last_chance);
      if (drawn) {
        queue_.pop_front();
      }
      return drawn;
    } catch (const InputError& error) {
      if (error.reason() == "missing_transform" && !last_chance) {
        return nullptr;
      }
      queue_.pop_front();
      monitor_.dropped(error);
    }
  }
  return nullptr;
}

bool CameraView::hasWaitedTooLong(const Waiting& waiting, Stamp now) const {
  const double waited = secondsBetween(waiting.since, now);
  return waited > options_.wait || waited < 0.0;
}

/// Null if there are none within `track_timeout`.
const TrackArray* CameraView::nearestTracks(Stamp stamp) const {
  const TrackArray* nearest = nullptr;
  double smallest = options_.track_timeout;
  for (const TrackArrayConstPtr& tracks : tracks_) {
    const double distance = std::abs(secondsBetween(toStamp(tracks->header.stamp), stamp));
    if (distance <= smallest) {
      nearest = tracks.get();
      smallest = distance;
    }
  }
  return nearest;
}

/// Null while closer tracks may still be received. Throws InputError.
sensor_msgs::ImagePtr CameraView::draw(const sensor_msgs::ImageConstPtr& image,
                                       bool wait_for_tracks) {
  const Stamp stamp = toStamp(image->header.stamp);
  const bool newer = !tracks_.empty() && toStamp(tracks_.back()->header.stamp) >= stamp;
  if (wait_for_tracks && !newer) {
    return nullptr;
  }
  camera_.check(*image);  // the info may have changed while the image waited
  const Stopwatch watch;
  const TrackArray* tracks = nearestTracks(stamp);
  const cv_bridge::CvImagePtr canvas = colorCopy(*image);
  if (tracks != nullptr) {
    const Eigen::Isometry3d camera_in_fixed = poseAt(transforms_.core(), tracks->header.frame_id,
                                                     image->header.frame_id, image->header.stamp);
    drawTracks(*tracks, stamp, camera_in_fixed.inverse(), canvas->image);
  } else {
    monitor_.warned(InputError("old_tracks", "no tracks within " +
                                                 std::to_string(options_.track_timeout) +
                                                 " s of an image: it is shown without boxes"));
  }
  monitor_.processed({stamp, watch.seconds()});
  return canvas->toImageMsg();
}

void CameraView::drawTracks(const TrackArray& tracks, Stamp stamp,
                            const Eigen::Isometry3d& fixed_in_camera, cv::Mat& canvas) const {
  const double later = secondsBetween(toStamp(tracks.header.stamp), stamp);
  std::vector<TrackBox> boxes;
  for (const TrackMessage& track : tracks.tracks) {
    TrackBox box = trackBox(track, later, fixed_in_camera, options_);
    box.box.pose.pretranslate(Eigen::Vector3d(-camera_.shift(), 0.0, 0.0));
    box.distance = box.box.pose.translation().norm();
    if (box.distance <= options_.max_distance) {
      boxes.push_back(box);
    }
  }
  drawTrackBoxes(camera_.pinhole(), std::move(boxes), options_, canvas);
}

}  // namespace datmo
