// SPDX-License-Identifier: BSD-3-Clause
// Displays of objects, of the road's borders and of risks.
#include <algorithm>
#include <string>

#include "drawing_display.h"

#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/display/markers.h"
#include "datmo_fusion/ros/display/risk_style.h"

namespace datmo {

/// Objects of one measurement: outlines by sensor, bodies by class.
class ObjectsDisplay : public DrawingDisplay<ObjectArray> {
 public:
  ObjectsDisplay() {
    bodies_ = toggle("Bodies", true, "Shapes of objects whose class is known.");
    line_width_ = number("Line width [m]", MarkersOptions().line_width, {0.01F, 2.0F},
                         "Width of outlines: violet lidar, cyan stereo, yellow both, gray others.");
  }

 private:
  visualization_msgs::MarkerArray draw(const ObjectArray& objects) const override {
    MarkersOptions options;
    options.line_width = static_cast<double>(line_width_->getFloat());
    const bool bodies = bodies_->getBool();
    return onlyShown(markersOf(objects, options),
                     [bodies](const std::string& part) { return bodies || part == "objects"; });
  }

  rviz::BoolProperty* bodies_;
  rviz::FloatProperty* line_width_;
};

/// The road's borders, with their 95 % bands.
class RoadBordersDisplay : public DrawingDisplay<RoadBorders> {
 public:
  RoadBordersDisplay() {
    deviations_ = toggle("Deviations", true, "Lines at two standard deviations to both sides.");
    line_width_ =
        number("Line width [m]", MarkersOptions().line_width, {0.01F, 2.0F},
               "Width of the least certain borders; certain ones are three times as wide.");
  }

 private:
  visualization_msgs::MarkerArray draw(const RoadBorders& road) const override {
    MarkersOptions options;
    options.line_width = static_cast<double>(line_width_->getFloat());
    const bool deviations = deviations_->getBool();
    return onlyShown(markersOf(road, options), [deviations](const std::string& part) {
      return deviations || part == "road borders";
    });
  }

  rviz::BoolProperty* deviations_;
  rviz::FloatProperty* line_width_;
};

/// The host's predicted path, and its possible contacts with their times.
class RiskDisplay : public DrawingDisplay<RiskArray> {
 public:
  RiskDisplay() {
    const RiskStyle style;
    tube_ = toggle("Host tube", true,
                   "The ground that the host is expected to cover: red now, green at the end of "
                   "the prediction.");
    contacts_ = toggle("Contacts", true, "Where objects are at contact, colored by its time.");
    labels_ =
        toggle("Labels", true, "Time, probability and speed of contacts; the level's reason.");
    min_probability_ = number("Min probability [1]", style.min_probability, {0.0F, 1.0F},
                              "Contacts less likely within 4 s are not drawn.");
    text_height_ = number("Text height [m]", style.text_height, {0.1F, 10.0F}, "Height of labels.");
  }

 private:
  visualization_msgs::MarkerArray draw(const RiskArray& risks) const override {
    RiskStyle style;
    style.min_probability = static_cast<double>(min_probability_->getFloat());
    style.text_height = static_cast<double>(text_height_->getFloat());
    return onlyShown(markersOf(risks, style), [this](const std::string& part) {
      if (part == "host tube") {
        return tube_->getBool();
      }
      return part == "contacts" ? contacts_->getBool() : labels_->getBool();
    });
  }

  rviz::BoolProperty* tube_;
  rviz::BoolProperty* contacts_;
  rviz::BoolProperty* labels_;
  rviz::FloatProperty* min_probability_;
  rviz::FloatProperty* text_height_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::ObjectsDisplay, rviz::Display)
PLUGINLIB_EXPORT_CLASS(datmo::RoadBordersDisplay, rviz::Display)
PLUGINLIB_EXPORT_CLASS(datmo::RiskDisplay, rviz::Display)
