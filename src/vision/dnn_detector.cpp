// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/dnn_detector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <utility>

#include "image_check.h"
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "datmo_fusion/vision/network_decoding.h"

namespace datmo {

namespace {

constexpr int kInputStep = 32;      ///< px: networks halve their input five times
constexpr double kPadding = 114.0;  ///< gray level of the padding, as in training
constexpr double kByte = 255.0;
constexpr std::size_t kDarknetHeader = 16;  ///< bytes before the weights, at least
constexpr double kSamePerson = 0.3;  ///< intersection over union of both detections of a person

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

[[noreturn]] void refuse(const std::string& file, const std::string& why,
                         const std::string& remedy = "") {
  throw ModelError("model '" + file + "': " + why +
                   ": expected a complete YOLO of Darknet (.weights, its .cfg beside it) or YOLOX "
                   "(.onnx)" +
                   remedy);
}

void checkFile(const std::string& file) {
  if (!std::ifstream(file, std::ios::binary)) {
    refuse(file, "cannot be read");
  }
}

/// Reads one name per line. Throws ModelError.
std::vector<NetworkLabel> labelsFrom(const std::string& file) {
  constexpr char kExpected[] = ": expected one name per line, as in coco.names";
  std::ifstream in(file);
  if (!in) {
    throw ModelError("labels '" + file + "': cannot be read" + kExpected);
  }
  std::vector<NetworkLabel> labels;
  for (std::string line; std::getline(in, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (!line.empty()) {
      labels.push_back(labelOf(line));
    }
  }
  if (std::all_of(labels.begin(), labels.end(),
                  [](NetworkLabel one) { return one == NetworkLabel::kOther; })) {
    throw ModelError("labels '" + file + "': " + std::to_string(labels.size()) +
                     " names, none of a road user" + kExpected);
  }
  return labels;
}

/// An image scaled to a network's input, aligned at the upper left corner.
struct Fitted {
  cv::Mat image;
  double zoom = 1.0;
};

Fitted fitted(const cv::Mat& image, const NetworkSize& input) {
  Fitted result;
  result.zoom = std::min(static_cast<double>(input.width) / image.cols,
                         static_cast<double>(input.height) / image.rows);
  const cv::Size size(std::clamp(cvRound(result.zoom * image.cols), 1, input.width),
                      std::clamp(cvRound(result.zoom * image.rows), 1, input.height));
  cv::Mat scaled;
  cv::resize(image, scaled, size, 0.0, 0.0, result.zoom < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  cv::copyMakeBorder(scaled, result.image, 0, input.height - size.height, 0,
                     input.width - size.width, cv::BORDER_CONSTANT, cv::Scalar::all(kPadding));
  return result;
}

NetworkOutput outputOf(const cv::Mat& blob) {
  const int columns = blob.size[blob.dims - 1];
  const int rows = columns > 0 ? static_cast<int>(blob.total()) / columns : 0;
  return {blob.ptr<float>(), rows, columns};
}

}  // namespace

class DnnDetector::State {
 public:
  explicit State(const DnnDetectorOptions& options) : options_(options) {
    load();
    labels_ = options.labels.empty() ? cocoLabels() : labelsFrom(options.labels);
    tryOut();
  }

  std::vector<ImageDetection> detect(const cv::Mat& image) {
    cv::Mat color = image;
    if (image.channels() == 1) {
      cv::cvtColor(image, color, cv::COLOR_GRAY2BGR);
    }
    const std::vector<ImageDetection> users =
        roadUsers(look(color, {options_.width, options_.height}), options_.max_overlap);
    return options_.close_look > 0 ? lookedAtAgain(color, users) : users;
  }

 private:
  void load() {
    const std::string& model = options_.model;
    is_darknet_ = endsWith(model, ".weights");
    if (model.empty() || (!is_darknet_ && !endsWith(model, ".onnx"))) {
      refuse(model, "unknown kind of file");
    }
    checkFile(model);
    try {
      if (is_darknet_) {
        const std::string cfg = model.substr(0, model.size() - std::string(".weights").size());
        checkFile(cfg + ".cfg");
        network_ = cv::dnn::readNetFromDarknet(cfg + ".cfg", model);
        checkWeights();
      } else {
        network_ = cv::dnn::readNetFromONNX(model);
      }
    } catch (const cv::Exception& error) {
      refuse(model, error.err);
    }
    network_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    network_.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
    outputs_ = network_.getUnconnectedOutLayersNames();
  }

  /// OpenCV silently reads beyond the end of a truncated weights file.
  void checkWeights() {
    std::size_t needed = kDarknetHeader;
    for (const std::string& name : network_.getLayerNames()) {
      const cv::Ptr<cv::dnn::Layer> layer = network_.getLayer(network_.getLayerId(name));
      if (layer->type == "Region") {
        continue;  // its anchors are in the .cfg
      }
      for (const cv::Mat& blob : layer->blobs) {
        needed += blob.total() * blob.elemSize();
      }
    }
    std::ifstream file(options_.model, std::ios::binary | std::ios::ate);
    const auto size = static_cast<std::size_t>(std::max<std::streamoff>(0, file.tellg()));
    if (size < needed) {
      refuse(options_.model, std::to_string(size) + " bytes, of " + std::to_string(needed) +
                                 " that its .cfg asks for");
    }
  }

  /// First runs, on an empty image of each size: a network may take only one.
  void tryOut() {
    tryOutAt({options_.width, options_.height},
             "set dnn/width and dnn/height to the size of the network's input");
    if (options_.close_look > 0 && options_.max_close_looks > 0) {
      tryOutAt({options_.close_look, options_.close_look},
               "set dnn/close_look to 0 to not examine persons again, or use another network");
    }
  }

  void tryOutAt(const NetworkSize& size, const std::string& remedy) {
    const std::string input =
        "an input of " + std::to_string(size.width) + " x " + std::to_string(size.height) + " px";
    try {
      look(cv::Mat(size.height, size.width, CV_8UC3, cv::Scalar::all(kPadding)), size);
    } catch (const cv::Exception& error) {
      refuse(options_.model, input + " fails: " + error.err, " for that size; " + remedy);
    } catch (const std::runtime_error& error) {
      refuse(options_.model, input + " fails: " + error.what(), " for that size; " + remedy);
    }
  }

  /// Boxes in px of the image.
  std::vector<NetworkDetection> look(const cv::Mat& image, const NetworkSize& input) {
    const Fitted fit = fitted(image, input);
    // Darknet's networks are trained on RGB scaled to 0 to 1, YOLOX on BGR bytes.
    cv::Mat blob;
    cv::dnn::blobFromImage(fit.image, blob, is_darknet_ ? 1.0 / kByte : 1.0, cv::Size(),
                           cv::Scalar(), is_darknet_);
    network_.setInput(blob);
    std::vector<cv::Mat> outputs;
    network_.forward(outputs, outputs_);
    std::vector<NetworkDetection> things;
    for (const cv::Mat& output : outputs) {
      const auto decode = is_darknet_ ? decodeYolo : decodeYolox;
      auto found = decode(outputOf(output), input, labels_, options_.min_score);
      std::move(found.begin(), found.end(), std::back_inserter(things));
    }
    for (NetworkDetection& thing : things) {
      thing.box = {thing.box.min() / fit.zoom, thing.box.max() / fit.zoom};
    }
    return things;
  }

  /// Persons and riders detected at higher resolution, the largest first.
  std::vector<ImageDetection> lookedAtAgain(const cv::Mat& image,
                                            std::vector<ImageDetection> users) {
    std::stable_sort(users.begin(), users.end(), [](const auto& a, const auto& b) {
      return a.box.sizes().y() > b.box.sizes().y();
    });
    int left = options_.max_close_looks;
    for (ImageDetection& user : users) {
      if (user.object_class != ObjectClass::kVehicle && left-- > 0) {
        user = lookedAtAgain(image, user);
      }
    }
    return withoutDuplicates(std::move(users), options_.max_overlap);
  }

  ImageDetection lookedAtAgain(const cv::Mat& image, const ImageDetection& user) {
    const double half = 0.5 * options_.close_margin * user.box.sizes().maxCoeff();
    const Eigen::Vector2d corner = user.box.center() - Eigen::Vector2d::Constant(half);
    const cv::Rect part =
        cv::Rect(cvFloor(corner.x()), cvFloor(corner.y()), cvCeil(2.0 * half), cvCeil(2.0 * half)) &
        cv::Rect(0, 0, image.cols, image.rows);
    if (part.empty()) {
      return user;
    }
    ImageDetection result = user;
    double best = kSamePerson;
    for (ImageDetection close : roadUsers(
             look(image(part), {options_.close_look, options_.close_look}), options_.max_overlap)) {
      close.box.translate(Eigen::Vector2d(part.x, part.y));
      const double same = overlap(close.box, user.box);
      if (close.object_class != ObjectClass::kVehicle && same > best) {
        best = same;
        result = close;
      }
    }
    return result;
  }

  DnnDetectorOptions options_;
  cv::dnn::Net network_;
  bool is_darknet_ = false;
  std::vector<std::string> outputs_;
  std::vector<NetworkLabel> labels_;
};

void DnnDetectorOptions::visit(OptionVisitor& visitor) {
  visitor.text({"model", "",
                "path of a Darknet YOLO (.weights, its .cfg beside it) or a YOLOX (.onnx), trained "
                "on COCO or on the classes of `labels`"},
               model, {});
  visitor.text(
      {"labels", "", "path of the names of its classes, one per line; empty: the 80 of COCO"},
      labels, {});
  visitor.integer({"width", "px", "width of the network's input, a multiple of 32"}, width,
                  {64.0, 4096.0});
  visitor.integer({"height", "px", "height of the network's input, a multiple of 32"}, height,
                  {64.0, 4096.0});
  visitor.number({"min_score", "1", "minimum score of reported detections"}, min_score,
                 {0.01, 1.0});
  visitor.integer({"close_look", "px",
                   "persons are examined again, enlarged to a square of this size, to see whether "
                   "they ride; a multiple of 32; 0: not examined again"},
                  close_look, {0.0, 1024.0});
  visitor.integer(
      {"max_close_looks", "1", "maximum number per image, the largest first: bounds its time"},
      max_close_looks, {0.0, 100.0});
}

void DnnDetectorOptions::check() const {
  if (width % kInputStep != 0 || height % kInputStep != 0 || close_look % kInputStep != 0) {
    throw OptionError(
        "dnn: width = " + std::to_string(width) + ", height = " + std::to_string(height) +
        ", close_look = " + std::to_string(close_look) + ": expected multiples of 32 px");
  }
}

DnnDetector::DnnDetector(const Checked<DnnDetectorOptions>& options)
    : state_(std::make_unique<State>(*options)) {}

DnnDetector::~DnnDetector() = default;

std::vector<ImageDetection> DnnDetector::detect(const cv::Mat& image,
                                                const std::vector<ImageRegion>& /*regions*/) {
  checkImage(image);
  return state_->detect(image);
}

}  // namespace datmo
