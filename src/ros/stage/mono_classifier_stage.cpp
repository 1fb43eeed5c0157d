// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/mono_classifier_stage.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include <boost/make_shared.hpp>
#include <opencv2/core/utility.hpp>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/fusion/sync/relative_motion.h"
#include "datmo_fusion/ros/convert/image_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"
#include "datmo_fusion/tracking/object_check.h"

namespace datmo {

namespace {

/// Converts errors to OptionError: the host stops with its message.
std::unique_ptr<MonoClassifier> makeClassifier(const MonoClassifierOptions& options) {
  try {
    return std::make_unique<MonoClassifier>(options);
  } catch (const ModelError& error) {
    throw OptionError(std::string("dnn: ") + error.what());
  }
}

/// Lowers the priority of the detector's thread, so that no scan waits for it. If that is not
/// permitted, the priority stays unchanged.
void giveWay(const MonoClassifierStageOptions& options) {
  if (options.detector_threads > 0) {
    cv::setNumThreads(options.detector_threads);
  }
  // On Linux this applies only to this thread and those that it starts.
  const auto thread = static_cast<id_t>(syscall(SYS_gettid));
  setpriority(PRIO_PROCESS, thread,
              std::max(getpriority(PRIO_PROCESS, thread), options.detector_nice));
}

/// Returns the classified objects of a list, without points: they are matched by position.
ObjectList withClasses(const ObjectList& listed, const std::vector<ClassifiedObject>& classes) {
  ObjectList list;
  list.stamp = listed.stamp;
  for (const ClassifiedObject& one : classes) {
    Object object = listed.objects[one.index];
    object.points.clear();
    object.class_probabilities = one.probabilities;
    list.objects.push_back(std::move(object));
  }
  return list;
}

}  // namespace

void MonoClassifierStageOptions::visit(OptionVisitor& visitor) {
  visitor.number({"tolerance", "s", "objects within this time of the exposure are classified"},
                 tolerance, {0.0, 1.0});
  visitor.number(
      {"max_wait", "s",
       "longest time that an image waits for objects; without them the image is processed alone"},
      max_wait, {0.01, 2.0});
  visitor.number(
      {"max_age", "s", "an image older than the newest objects by more than this is dropped"},
      max_age, {0.0, 10.0});
  visitor.integer({"detector_threads", "1",
                   "threads that OpenCV may use, for the detector and, since it has no other "
                   "limit, for everything else in the process; 0: no limit. Not in run_bag"},
                  detector_threads, {0.0, 256.0});
  visitor.integer(
      {"detector_nice", "1",
       "nice value of the detector's thread (setpriority): the higher, the lower its priority"},
      detector_nice, {0.0, 19.0});
  exposure.visit(visitor);
  visitor.group("input", [&] { input.visit(visitor); });
  classifier.visit(visitor);
}

MonoClassifierStage::MonoClassifierStage(const Checked<MonoClassifierStageOptions>& options,
                                         const TransformBuffer& transforms, StageMonitor& monitor,
                                         const StepClock& clock)
    : MonoClassifierStage(options, transforms, monitor, clock,
                          makeClassifier(options->classifier)) {}

MonoClassifierStage::MonoClassifierStage(const Checked<MonoClassifierStageOptions>& options,
                                         const TransformBuffer& transforms, StageMonitor& monitor,
                                         const StepClock& clock,
                                         std::unique_ptr<MonoClassifier> classifier)
    : options_(*options),
      transforms_(transforms),
      monitor_(monitor),
      runner_(monitor, options->input, "forgets all objects", [this] { reset(); }),
      motion_(options->motion, options->frames, runner_),
      exposure_(options->exposure),
      wait_(options->tolerance, options->max_wait),
      classifier_(std::move(classifier)),
      worker_([this](const Job& job) { return work(*classifier_, job); }, clock != nullptr,
              [this] { giveWay(options_); }) {}

void MonoClassifierStage::reset() {
  motion_.reset();
  wait_.clear();
  exposure_.reset();
  results_.clear();
  classified_.reset();
  ++run_;  // invalidates what the detector is still processing
}

void MonoClassifierStage::handleCameraInfo(const sensor_msgs::CameraInfo& message) {
  runner_.serve([&] { camera_.update(message); });
}

void MonoClassifierStage::handleObjects(const ObjectArray& message) {
  runner_.serve([&] {
    if (message.header.frame_id != options_.frames.base) {
      throw InputError("wrong_frame", "objects in '" + message.header.frame_id + "': expected '" +
                                          options_.frames.base + "'");
    }
    const auto list = std::make_shared<const ObjectList>(fromMessage(message));
    runner_.check("objects", message.header.stamp);
    wait_.addMeasurement(list->stamp, list);
  });
}

void MonoClassifierStage::handleImage(const sensor_msgs::ImageConstPtr& message, Stamp now) {
  runner_.serve([&] {
    camera_.check(*message);
    exposure_.check(message);
    checkAge(*message);
    runner_.check("image", message->header.stamp);
    exposure_.accept(message);
    if (!classifier_->isInformative()) {
      monitor_.warned(
          InputError("detector_tells_nothing",
                     "images do not classify any object: this detector's reports are no more often "
                     "right than by chance (`reliability`); expected detector: dnn with a model, "
                     "or a reliability that `evaluate calibrate_classes` measured on your images"));
    }
    if (!wait_.addImage(message, now)) {
      monitor_.dropped(
          InputError("superseded_image",
                     "a newer image arrived before objects for this one: expected objects at the "
                     "rate of the images; continues with the newer one"));
    }
  });
}

/// Throws InputError.
void MonoClassifierStage::checkAge(const sensor_msgs::Image& image) const {
  const Stamp exposure = toStamp(image.header.stamp);
  const double age = secondsBetween(exposure, wait_.newestStamp().value_or(exposure));
  // After a jump of the clock it is not old, but starts over.
  if (age > options_.max_age && age < options_.input.restart_after) {
    throw InputError("old_image", "image " + std::to_string(age) +
                                      " s older than the newest objects: expected at most " +
                                      std::to_string(options_.max_age) + " s");
  }
}

MonoClassifierStage::Job MonoClassifierStage::jobOf(const sensor_msgs::ImageConstPtr& image) const {
  const Stamp exposure = toStamp(image->header.stamp);
  Job job{image, camera_.mounted(*image, options_.frames, transforms_), nullptr, {}, run_};
  job.objects.stamp = exposure;
  const Listed* const listed = wait_.nearest(exposure);
  if (listed == nullptr) {
    return job;
  }
  const auto motion = [this](Stamp from, Stamp to) { return motion_.between(from, to); };
  // Pose of the vehicle at the objects' time, in its frame at the exposure.
  const auto base = baseAt((*listed)->stamp, exposure, motion);
  if (!base) {
    monitor_.warned(InputError("no_motion",
                               "no objects used: expected odometry or poses that give the "
                               "vehicle's motion between their stamp and the image's"));
    return job;
  }
  job.listed = *listed;
  const double later = secondsBetween(exposure, job.listed->stamp);
  for (const Object& object : job.listed->objects) {
    Object moved = transformed(*base, object);
    moved.delay += later;
    if (moved.dynamic_state != DynamicState::kStatic) {
      moved.position_covariance +=
          square(options_.object_speed * moved.delay) * Eigen::Matrix2d::Identity();
    }
    job.objects.objects.push_back(std::move(moved));
  }
  return job;
}

void MonoClassifierStage::startIfReady(Stamp now) {
  const sensor_msgs::ImageConstPtr image = wait_.next(now);
  if (!image) {
    return;
  }
  if (worker_.start(jobOf(image))) {
    monitor_.dropped(
        InputError("slow_detector",
                   "a newer image arrived before the detector had started on one: expected a "
                   "faster machine, a smaller network or fewer images per second"));
  }
}

MonoClassifierStage::Result MonoClassifierStage::work(MonoClassifier& classifier, const Job& job) {
  const Stopwatch watch;
  Result result;
  result.listed = job.listed;
  result.run = job.run;
  try {
    const auto pixels = grayOrColor(job.image);
    result.classification = classifier.classify(pixels->image, job.camera, job.objects);
  } catch (const std::exception& error) {  // of OpenCV: must not end the thread
    result.error = error.what();
  }
  result.seconds = watch.seconds();
  return result;
}

std::optional<MonoObjects> MonoClassifierStage::next(Stamp now) {
  return runner_.serve([&]() -> std::optional<MonoObjects> {
    startIfReady(now);
    for (Result& result : worker_.take()) {
      if (result.run == run_) {
        results_.push_back(std::move(result));
      }
    }
    if (results_.empty()) {
      return std::nullopt;
    }
    const Result result = std::move(results_.front());
    results_.pop_front();
    return show(result);
  });
}

/// Throws InputError.
MonoObjects MonoClassifierStage::show(const Result& result) {
  if (!result.error.empty()) {
    throw InputError("detector_failed", "the detector refused an image: " + result.error);
  }
  const MonoClassification& found = result.classification;
  monitor_.figure("objects in view", static_cast<double>(found.in_view));
  monitor_.figure("detections", static_cast<double>(found.detections));
  monitor_.figure("objects classified", static_cast<double>(found.classes.size()));
  monitor_.figure("objects from the image alone", static_cast<double>(found.alone.objects.size()));
  monitor_.figure("detector's time [s]", result.seconds);
  monitor_.processed({found.alone.stamp, result.seconds});
  const std::string& frame = options_.frames.base;
  MonoObjects messages;
  if (result.listed && (!classified_ || *classified_ < result.listed->stamp)) {
    classified_ = result.listed->stamp;
    messages.classes = boost::make_shared<ObjectArray>(
        toMessage(withClasses(*result.listed, found.classes), frame));
  }
  messages.alone = boost::make_shared<ObjectArray>(toMessage(found.alone, frame));
  return messages;
}

void MonoClassifierStage::connect(StagePorts& ports) {
  classes_ = ports.out<ObjectArray>("objects/classes");
  alone_ = ports.out<ObjectArray>("objects/mono");
  connectMotion(ports, options_.motion, *this);
  ports.optionalIn<sensor_msgs::CameraInfo>(
      "camera_info", [this](const auto& info, Stamp /*now*/) { handleCameraInfo(*info); });
  ports.in<ObjectArray>("objects",
                        [this](const auto& objects, Stamp /*now*/) { handleObjects(*objects); });
  ports.in<sensor_msgs::Image>("image",
                               [this](const auto& image, Stamp now) { handleImage(image, now); });
}

bool MonoClassifierStage::publishNext(Stamp now) {
  const std::optional<MonoObjects> objects = next(now);
  if (objects) {
    classes_.publish(objects->classes);
    alone_.publish(objects->alone);
  }
  return objects.has_value();
}

}  // namespace datmo
