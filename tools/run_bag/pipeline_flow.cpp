// How messages go on from stage to stage in the Pipeline.
#include <utility>

#include "pipeline.h"

namespace datmo {

void Pipeline::feedCloud(const sensor_msgs::PointCloud2& cloud, Stamp now, Output& output) {
  if (low_level_) {
    low_level_->takeCloud(cloud, now, output.grids);
  }
  if (!stereo_objects_) {
    return;
  }
  if (const ObjectArrayPtr found = stereo_objects_->takeCloud(cloud)) {
    bookTime(stereo_objects_monitor_);
    output.objects.emplace_back("stereo", found);
    feedObjects("stereo", found, now);
  }
}

void Pipeline::feedMadeCloud(const sensor_msgs::PointCloud2Ptr& cloud, Stamp now, Output& output) {
  if (cloud) {
    bookTime(images_monitor_);
    feedCloud(*cloud, now, output);
  }
}

void Pipeline::feedObjects(const std::string& source, const ObjectArrayConstPtr& objects,
                           Stamp now) {
  if (object_fusion_) {
    object_fusion_->takeObjects(source, *objects, now);
  }
  if (track_fusion_ && source == "stereo") {
    track_fusion_->takeStereoObjects(objects, now);
  }
}

void Pipeline::followFusion(Stamp now, Output& output) {
  followGrids(now, output);
  followObjects(now, output);
  followTracks(now, output);
}

void Pipeline::followGrids(Stamp now, Output& output) {
  if (!low_level_) {
    return;
  }
  while (const auto fused = low_level_->nextFused(now, output.grids)) {
    if (last_ == LastStage::kGridFusion) {
      continue;
    }
    if (auto slam = slam_.takeGrid(*fused)) {
      low_level_->takePose(*slam->pose);
      followSlam(std::move(*slam), now, output);
    }
  }
}

void Pipeline::followObjects(Stamp now, Output& output) {
  if (!object_fusion_) {
    return;
  }
  while (const ObjectArrayPtr fused = object_fusion_->nextFused(now, output.objects)) {
    if (reaches(LastStage::kTracker)) {
      tracker_.takeObjects(fused, now);
    }
  }
}

void Pipeline::followSlam(GridSlamOutput slam, Stamp now, Output& output) {
  bookTime(slam_monitor_);
  tf2_msgs::TFMessage map_to_odom;
  map_to_odom.transforms = slam.transforms;
  transforms_.add(map_to_odom);
  if (last_ != LastStage::kGridSlam) {
    detect(slam, now, output);
  }
  if (const auto map = slam_.mapIfDue(toStamp(slam.pose->header.stamp))) {
    output.maps.push_back(map);
  }
  output.slam.push_back(std::move(slam));
}

void Pipeline::detect(const GridSlamOutput& slam, Stamp now, Output& output) {
  if (reaches(LastStage::kTracker)) {
    tracker_.takeSplitScan(*slam.split_scan);
  }
  if (track_fusion_) {
    track_fusion_->takeSplitScan(*slam.split_scan);
  }
  if (object_fusion_) {
    object_fusion_->takePose(*slam.pose);
    object_fusion_->takeSplitScan(*slam.split_scan);
  }
  findBorders(*slam.split_scan, output);
  if (!reaches(LastStage::kMovingObjects)) {
    return;
  }
  if (const auto found = detector_.takeSplitScan(*slam.split_scan)) {
    bookTime(detector_monitor_);
    output.objects.emplace_back("lidar", found->objects);
    if (found->dropped) {
      output.dropped.push_back(found->dropped);
    }
    if (object_fusion_) {
      object_fusion_->takeObjects("lidar", *found->objects, now);
    } else if (reaches(LastStage::kTracker)) {
      tracker_.takeObjects(found->objects, now);
    }
  }
  drainTracker(now, output);
}

void Pipeline::findBorders(const SplitScanMessage& split_scan, Output& output) {
  if (!road_border_) {
    return;
  }
  if (const RoadBordersPtr borders = road_border_->takeSplitScan(split_scan)) {
    bookTime(road_border_monitor_);
    detector_.takeRoadBorders(*borders);
    output.borders.push_back(borders);
  }
}

void Pipeline::followTracks(Stamp now, Output& output) {
  drainTracker(now, output);
  if (!track_fusion_) {
    return;
  }
  while (const TrackArrayPtr tracks = track_fusion_->nextStereo(now)) {
    output.source_tracks.emplace_back("stereo", tracks);
  }
  while (const TrackArrayPtr fused = track_fusion_->nextFused(now)) {
    output.tracks.push_back(fused);
  }
}

void Pipeline::drainTracker(Stamp now, Output& output) {
  while (const TrackArrayPtr tracks = tracker_.next(now)) {
    bookTime(tracker_monitor_);
    if (track_fusion_) {
      output.source_tracks.emplace_back("lidar", tracks);
      track_fusion_->takeTracks("lidar", *tracks, now);
    } else {
      output.tracks.push_back(tracks);
    }
  }
}

void Pipeline::bookTime(const StageMonitor& monitor) {
  times_.add(monitor.stage(), monitor.lastProcessed().seconds);
}

}  // namespace datmo
