// SPDX-License-Identifier: BSD-3-Clause
#include <map>
#include <string>

#include "drawing_display.h"
#include <rviz/properties/enum_property.h>

#include <pluginlib/class_list_macros.hpp>
#include <ros/package.h>

#include "datmo_fusion/ros/display/track_style.h"

namespace datmo {

/// Tracks as boxes or meshes by class, with ids, velocities, covariances, past and predicted paths.
class TracksDisplay : public DrawingDisplay<TrackArray> {
 public:
  TracksDisplay() {
    shape_ = watched(new rviz::EnumProperty(
        "Shape", "mesh",
        "Meshes of vehicles, pedestrians and cyclists in the size of the track, or boxes.", this));
    shape_->addOption("box", static_cast<int>(TrackShape::kBox));
    shape_->addOption("mesh", static_cast<int>(TrackShape::kMesh));
    color_by_ = watched(new rviz::EnumProperty("Color by", "class", "What the colors mean.", this));
    color_by_->addOption("class", static_cast<int>(TrackColor::kClass));
    color_by_->addOption("id", static_cast<int>(TrackColor::kId));
    color_by_->addOption("speed", static_cast<int>(TrackColor::kSpeed));
    color_by_->addOption("sensors", static_cast<int>(TrackColor::kSensors));
    addParts();
    const TrackStyle style;
    fade_ = toggle("Fade by existence", true,
                   "The less certain a track's existence, the more transparent it is.");
    min_existence_ = number("Min existence [1]", 0.0, {0.0F, 1.0F},
                            "Tracks with a lower existence probability are not drawn.");
    min_mode_ = number("Min mode probability [1]", style.min_mode, {0.0F, 1.0F},
                       "Less likely modes of motion have no predicted path.");
    prediction_time_ = number("Prediction [s]", style.prediction_time, {0.2F, 10.0F},
                              "How far ahead the predicted paths reach.");
    path_time_ = number("History [s]", style.sizes.path_time, {0.0F, 600.0F},
                        "How far back the drawn path reaches.");
    arrow_time_ = number("Velocity arrow [s]", style.sizes.arrow_time, {0.0F, 10.0F},
                         "An arrow is the distance traveled in this time.");
    text_height_ =
        number("Text height [m]", style.sizes.text_height, {0.1F, 10.0F}, "Height of labels.");
    line_width_ = number("Line width [m]", style.sizes.line_width, {0.01F, 2.0F},
                         "Width of outlines and paths; arrows scale with it.");
  }

 private:
  void onInitialize() override {
    DrawingDisplay::onInitialize();
    try {
      meshes_ = readClassMeshes(ros::package::getPath("datmo_fusion"));
    } catch (const MeshError& error) {
      set("Meshes", {rviz::StatusProperty::Error, std::string("boxes instead: ") + error.what()});
    }
  }

  /// Adds properties for the parts of the picture, by marker namespace.
  void addParts() {
    rviz::Property* bodies = toggle("Bodies", true, "Boxes or meshes by class.");
    parts_["track bodies"] = bodies;
    parts_["track heads"] = bodies;
    parts_["track outlines"] = toggle("Outlines", true, "The outline of the box on the ground.");
    parts_["track sensors"] =
        toggle("Sensors", false,
               "Outlines by the sensors that saw it: violet lidar, cyan stereo, yellow both.");
    parts_["track labels"] = toggle("Labels", true, "Id, class and speed [m/s].");
    parts_["track velocities"] = toggle("Velocities", true, "Arrows of moving tracks.");
    parts_["track covariances"] =
        toggle("Covariances", false,
               "The ellipse that contains the true position with a probability of 95 %.");
    parts_["track paths"] = toggle("History", true, "The path so far.");
    parts_["track predictions"] =
        toggle("Predicted paths", true, "The predicted path of each likely mode of motion.");
  }

  TrackStyle style() const {
    TrackStyle style;
    if (!meshes_.empty()) {
      style.shape = static_cast<TrackShape>(shape_->getOptionInt());
    }
    style.color_by = static_cast<TrackColor>(color_by_->getOptionInt());
    style.fade_by_existence = fade_->getBool();
    style.min_existence = static_cast<double>(min_existence_->getFloat());
    style.min_mode = static_cast<double>(min_mode_->getFloat());
    style.prediction_time = static_cast<double>(prediction_time_->getFloat());
    style.sizes.path_time = static_cast<double>(path_time_->getFloat());
    style.sizes.arrow_time = static_cast<double>(arrow_time_->getFloat());
    style.sizes.text_height = static_cast<double>(text_height_->getFloat());
    style.sizes.line_width = static_cast<double>(line_width_->getFloat());
    return style;
  }

  visualization_msgs::MarkerArray draw(const TrackArray& tracks) const override {
    const TrackStyle chosen = style();
    visualization_msgs::MarkerArray markers = markersOf(tracks, chosen);
    if (parts_.at("track predictions")->getValue().toBool()) {
      const visualization_msgs::MarkerArray ahead = predictionsOf(tracks, chosen);
      markers.markers.insert(markers.markers.end(), ahead.markers.begin(), ahead.markers.end());
    }
    return onlyShown(std::move(markers), [this](const std::string& part) {
      return parts_.at(part)->getValue().toBool();
    });
  }

  std::map<std::string, rviz::Property*> parts_;
  rviz::EnumProperty* shape_;
  rviz::EnumProperty* color_by_;
  rviz::BoolProperty* fade_;
  rviz::FloatProperty* min_existence_;
  rviz::FloatProperty* min_mode_;
  rviz::FloatProperty* prediction_time_;
  rviz::FloatProperty* path_time_;
  rviz::FloatProperty* arrow_time_;
  rviz::FloatProperty* text_height_;
  rviz::FloatProperty* line_width_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::TracksDisplay, rviz::Display)
