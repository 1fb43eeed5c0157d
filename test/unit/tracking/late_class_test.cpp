// SPDX-License-Identifier: BSD-3-Clause
// Classes that arrive later than their objects, as those of a slow detector in images: each counts
// for the target of its object, wherever that is by then.
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

#include "tracking_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/tracking/early_tracker.h"
#include "datmo_fusion/tracking/object_check.h"

namespace datmo::late_class_test {
namespace {

constexpr double kPeriod = 0.1;  // s
constexpr int kSteps = 30;
constexpr int kPassing = 10;          // scan at which they are beside each other
constexpr double kSpeed = 4.0;        // m/s; within 0.4 s, each moves on by 1.6 m
constexpr double kDistance = 1.5;     // m, between their lines
constexpr double kProbability = 0.8;  // of the reported class

double cyclistAt(int step) { return kSpeed * kPeriod * (step - kPassing); }
double carAt(int step) { return -cyclistAt(step); }

Stamp stampOf(int step) { return Stamp::fromSeconds(100.0 + kPeriod * step); }

/// The vehicle drives and turns: classes are in its frame at their own stamp.
Pose2 vehicleAt(int step) { return {-20.0 + step, 3.0, 0.02 * step}; }

Object seenFrom(const Pose2& vehicle, const Object& object) {
  return transformed(vehicle.inverse(), object);
}

TrackerInput inputAt(int step) {
  const Pose2 vehicle = vehicleAt(step);
  const std::vector<Object> objects = {seenFrom(vehicle, objectAt(cyclistAt(step), 0.0)),
                                       seenFrom(vehicle, objectAt(carAt(step), kDistance))};
  return {{stampOf(step), objects, {}}, vehicle, Visibility(VisibilityOptions())};
}

ObjectList classesOf(int step) {
  ObjectList classes = inputAt(step).objects;
  classes.objects[0].class_probabilities = reportedClass(ObjectClass::kCyclist, kProbability);
  classes.objects[1].class_probabilities = reportedClass(ObjectClass::kVehicle, kProbability);
  return classes;
}

TrackerOptions optionsWith(TrackerAssociation association) {
  TrackerOptions options;
  options.require_motion = false;
  options.association = association;
  return options;
}

/// The track there; null if there is none.
const Track* trackAt(const TrackList& list, const Point2& position) {
  constexpr double kNear = 0.5;  // m
  for (const Track& track : list.tracks) {
    if ((track.state.head<2>() - position).norm() < kNear) {
      return &track;
    }
  }
  return nullptr;
}

/// Returns the class of the track there; none if there is no track.
std::optional<ObjectClass> classAt(const TrackList& list, const Point2& position) {
  const Track* const track = trackAt(list, position);
  return track == nullptr ? std::nullopt : std::optional(track->objectClass());
}

/// NaN if there is no track.
double probabilityAt(const TrackList& list, const Point2& position, ObjectClass object_class) {
  const Track* const track = trackAt(list, position);
  return track == nullptr ? std::numeric_limits<double>::quiet_NaN()
                          : probabilityOf(object_class, track->class_probabilities);
}

void expectClasses(const TrackList& tracks, int step) {
  EXPECT_EQ(classAt(tracks, {cyclistAt(step), 0.0}), ObjectClass::kCyclist) << step;
  EXPECT_EQ(classAt(tracks, {carAt(step), kDistance}), ObjectClass::kVehicle) << step;
}

/// By association, by the scans until the classes of a scan arrive, and by those until its complete
/// list does.
class LateClassTest : public testing::TestWithParam<std::tuple<TrackerAssociation, int, int>> {};

TEST_P(LateClassTest, EachReachesTheRightOneOfTwoThatPassEachOther) {
  const auto [association, lag, complete_lag] = GetParam();
  EarlyTracker tracker(optionsWith(association));
  int judged = 0;
  for (int step = 0; step < kSteps; ++step) {
    const TrackList tracks = tracker.processEarly(inputAt(step));
    // From the complete list of scan 3 on, both are confirmed.
    if (step > 3 + lag + complete_lag) {
      expectClasses(tracks, step);
      ++judged;
    }
    if (step >= lag) {
      tracker.addClasses(classesOf(step - lag));
    }
    if (step >= complete_lag) {
      tracker.process(inputAt(step - complete_lag));
    }
  }
  EXPECT_EQ(judged, kSteps - lag - complete_lag - 4);
  EXPECT_EQ(tracker.counts().classes.without_target, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Lags, LateClassTest,
    testing::Combine(testing::Values(TrackerAssociation::kMultipleHypotheses,
                                     TrackerAssociation::kGlobalNearestNeighbor),
                     testing::Values(1, 2, 3, 4), testing::Values(0, 1, 2)));

/// Beside a tracker that is told no classes: size and speed indicate one, too.
class LateClassInputTest : public testing::Test {
 protected:
  /// Both objects up to this scan.
  void follow(int last) {
    for (; next_ <= last; ++next_) {
      process(inputAt(next_));
    }
  }

  void process(const TrackerInput& input) {
    tracks_ = tracker_.process(input.objects, input.base_in_fixed, input.visibility);
    untold_tracks_ = untold_.process(input.objects, input.base_in_fixed, input.visibility);
  }

  /// By how much the classes that were told raise that probability of the object there.
  double gain(const Point2& position, ObjectClass object_class) const {
    return probabilityAt(tracks_, position, object_class) -
           probabilityAt(untold_tracks_, position, object_class);
  }
  double cyclistGain() const { return gain({cyclistAt(next_ - 1), 0.0}, ObjectClass::kCyclist); }
  double carGain() const { return gain({carAt(next_ - 1), kDistance}, ObjectClass::kVehicle); }

  LateClassCounts counts() const { return tracker_.counts().classes; }

  Tracker tracker_{optionsWith(TrackerAssociation::kMultipleHypotheses)};
  Tracker untold_{optionsWith(TrackerAssociation::kMultipleHypotheses)};
  TrackList tracks_;
  TrackList untold_tracks_;
  int next_ = 0;
};

TEST_F(LateClassInputTest, ThoseThatComeBeforeTheirObjectsWaitForThem) {
  follow(3);
  tracker_.addClasses(classesOf(4));
  follow(4);
  EXPECT_GT(cyclistGain(), 0.0);
  EXPECT_GT(carGain(), 0.0);
}

TEST_F(LateClassInputTest, ThoseThatAreTooOldAreCounted) {
  follow(8);
  tracker_.addClasses(classesOf(1));
  EXPECT_EQ(counts().without_target, 2U);
  follow(9);
  EXPECT_EQ(cyclistGain(), 0.0);
  EXPECT_EQ(carGain(), 0.0);
}

TEST_F(LateClassInputTest, ThoseOfUnknownScansOrObjectsAreCounted) {
  follow(5);
  ObjectList between = classesOf(4);
  between.stamp = between.stamp + 0.5 * kPeriod;
  tracker_.addClasses(between);
  EXPECT_EQ(counts().without_target, 2U);
  ObjectList elsewhere = classesOf(4);
  elsewhere.objects[0].box.center = Pose2(50.0, 50.0, 0.0);
  tracker_.addClasses(elsewhere);
  EXPECT_EQ(counts().without_target, 3U);
  follow(6);
  EXPECT_EQ(cyclistGain(), 0.0);
  EXPECT_GT(carGain(), 0.0);
}

/// Something that stands beside the cyclist, within the gate of his position. Without combinations
/// of objects, it is no part of him.
TEST_F(LateClassInputTest, ThatOfAnObjectWithoutTargetIsNotItsNeighbors) {
  tracker_ = Tracker(optionsWith(TrackerAssociation::kGlobalNearestNeighbor));
  untold_ = Tracker(optionsWith(TrackerAssociation::kGlobalNearestNeighbor));
  const auto standingAt = [](int step) {
    Object object = seenFrom(vehicleAt(step), objectAt(cyclistAt(step) + 0.2, 0.2));
    object.dynamic_state = DynamicState::kStatic;
    return object;
  };
  for (; next_ < 7; ++next_) {
    if (next_ == 6) {
      ObjectList classes{stampOf(5), {standingAt(5)}, {}};
      classes.objects[0].class_probabilities = reportedClass(ObjectClass::kVehicle, kProbability);
      tracker_.addClasses(classes);
    }
    TrackerInput input = inputAt(next_);
    input.objects.objects.push_back(standingAt(next_));
    process(input);
  }
  EXPECT_EQ(counts().without_target, 1U);
  EXPECT_EQ(cyclistGain(), 0.0);
}

TEST_F(LateClassInputTest, OneDetectionOfSeveralPiecesCountsOnce) {
  follow(5);
  ObjectList pieces = classesOf(5);
  Object piece = pieces.objects[0];
  piece.box.center = Pose2(piece.box.center.x() + 0.1, piece.box.center.y(), 0.0);
  piece.class_probabilities = reportedClass(ObjectClass::kPedestrian, kProbability);
  pieces.objects.insert(pieces.objects.begin(), piece);
  tracker_.addClasses(pieces);
  follow(6);
  EXPECT_GT(cyclistGain(), 0.0) << "of the nearest piece";
  EXPECT_EQ(counts().without_target, 0U);
}

TEST_F(LateClassInputTest, ThoseOfInvalidObjectsAreLeftOut) {
  follow(5);
  ObjectList bad = classesOf(5);
  bad.objects[0].position_covariance(0, 0) = std::numeric_limits<double>::quiet_NaN();
  tracker_.addClasses(bad);
  EXPECT_EQ(counts().rejected, 1U);
  follow(6);
  EXPECT_EQ(cyclistGain(), 0.0);
  EXPECT_GT(carGain(), 0.0);
}

TEST_F(LateClassInputTest, AfterAResetTheyAreForgotten) {
  follow(5);
  for (Tracker* const tracker : {&tracker_, &untold_}) {
    tracker->reset();
  }
  tracker_.addClasses(classesOf(5));
  next_ = 6;
  follow(10);
  EXPECT_EQ(counts().without_target, 2U);
  EXPECT_EQ(cyclistGain(), 0.0);
  EXPECT_EQ(carGain(), 0.0);
}

}  // namespace
}  // namespace datmo::late_class_test
