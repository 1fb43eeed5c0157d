// SPDX-License-Identifier: BSD-3-Clause
// Networks are not in the repository: if one is missing, its tests are skipped. The others use
// a tiny one, which they write themselves.
#include "datmo_fusion/vision/dnn_detector.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace datmo::dnn_detector_test {
namespace {

namespace fs = std::filesystem;

/// Beside the repository, like the data sets.
const fs::path kModels = fs::path(DATMO_FUSION_SHARED) / "models";
const fs::path kDarknet = kModels / "yolo-fastest-1.1-xl" / "yolo-fastest-1.1-xl.weights";
const fs::path kOnnx = kModels / "yolox_nano" / "yolox_nano.onnx";

/// The left gray camera of KITTI's drive 2011_09_26_0005.
const fs::path kImages = fs::path(DATMO_FUSION_SHARED) / "data/kitti_raw/2011_09_26" /
                         "2011_09_26_drive_0005_sync/image_00/data";

using Box = Eigen::AlignedBox2d;

/// Area of the intersection by that of the union.
double overlapOf(const Box& one, const Box& other) {
  const Box both = one.intersection(other);
  const double shared = both.isEmpty() ? 0.0 : both.volume();
  return shared / (one.volume() + other.volume() - shared);
}

bool isPerson(ObjectClass object_class) {
  return object_class == ObjectClass::kPedestrian || object_class == ObjectClass::kCyclist;
}

class DnnDetectorOf : public testing::TestWithParam<fs::path> {
 protected:
  void SetUp() override {
    if (!fs::exists(GetParam())) {
      GTEST_SKIP() << "needs the network " << GetParam() << ", which is not there";
    }
    options_.model = GetParam().string();
  }

  DnnDetectorOptions options_;
};

TEST_P(DnnDetectorOf, SeesNothingInEmptyImages) {
  DnnDetector detector(options_);
  for (const int gray : {0, 128, 255}) {
    EXPECT_TRUE(detector.detect(cv::Mat(375, 1242, CV_8UC1, cv::Scalar(gray)), {}).empty()) << gray;
    EXPECT_TRUE(detector.detect(cv::Mat(375, 1242, CV_8UC3, cv::Scalar::all(gray)), {}).empty())
        << gray;
  }
}

// A van, a cyclist and a pedestrian, outlined by hand.
TEST_P(DnnDetectorOf, FindsTheRoadUsersOfARealImage) {
  const fs::path file = kImages / "0000000000.png";
  if (!fs::exists(file)) {
    GTEST_SKIP() << "needs " << file << ", which is not there";
  }
  const Box van(Eigen::Vector2d(300.0, 168.0), Eigen::Vector2d(447.0, 287.0));
  const Box cyclist(Eigen::Vector2d(765.0, 170.0), Eigen::Vector2d(875.0, 375.0));
  const Box pedestrian(Eigen::Vector2d(1105.0, 178.0), Eigen::Vector2d(1195.0, 318.0));
  DnnDetector detector(options_);
  int vehicles = 0;
  int cyclists = 0;
  int pedestrians = 0;
  for (const auto& found : detector.detect(cv::imread(file.string(), cv::IMREAD_GRAYSCALE), {})) {
    constexpr double kMinOverlap = 0.5;
    vehicles +=
        found.object_class == ObjectClass::kVehicle && overlapOf(found.box, van) > kMinOverlap;
    cyclists += isPerson(found.object_class) && overlapOf(found.box, cyclist) > kMinOverlap;
    pedestrians += isPerson(found.object_class) && overlapOf(found.box, pedestrian) > kMinOverlap;
  }
  EXPECT_EQ(vehicles, 1);
  EXPECT_EQ(cyclists, 1);
  EXPECT_EQ(pedestrians, 1);
}

TEST_P(DnnDetectorOf, LabelsOfAnotherNumberAreRefused) {
  const fs::path labels = fs::path(testing::TempDir()) / "two_labels.txt";
  std::ofstream(labels) << "person\ncar\n";
  options_.labels = labels.string();
  EXPECT_THROW(DnnDetector{options_}, ModelError);
}

TEST_P(DnnDetectorOf, ATruncatedFileIsRefused) {
  const fs::path cut = fs::path(testing::TempDir()) / ("cut" + GetParam().extension().string());
  std::ifstream whole(GetParam(), std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(whole), {}};
  std::ofstream(cut, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size() / 2));
  fs::path cfg = GetParam();
  cfg.replace_extension(".cfg");
  if (fs::exists(cfg)) {
    fs::path cut_cfg = cut;
    cut_cfg.replace_extension(".cfg");
    fs::copy_file(cfg, cut_cfg, fs::copy_options::overwrite_existing);
  }
  options_.model = cut.string();
  EXPECT_THROW(DnnDetector{options_}, ModelError);
}

INSTANTIATE_TEST_SUITE_P(Networks, DnnDetectorOf, testing::Values(kDarknet, kOnnx),
                         [](const auto& one) { return one.index == 0 ? "Darknet" : "Onnx"; });

/// Returns a new file of the running test.
fs::path newFile(const std::string& ending) {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  return fs::path(testing::TempDir()) / (std::string(test.name()) + ending);
}

/// Of one convolution, whose input is pooled, upsampled and put beside itself: the sizes match only
/// for multiples of 64 px.
constexpr char kSizedNetwork[] = R"([net]
width=64
height=64
channels=3
[maxpool]
size=32
stride=32
[maxpool]
size=2
stride=2
[upsample]
stride=2
[route]
layers=-1,-3
[convolutional]
filters=85
size=1
stride=1
pad=0
activation=linear
[yolo]
mask=0
anchors=32,32
classes=80
num=1
)";

template <typename Numbers>
void append(std::ofstream& out, const Numbers& numbers) {
  out.write(reinterpret_cast<const char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof(numbers[0])));
}

/// Writes that network with COCO's labels, which detects a person in each of its cells of 32 px,
/// whatever the image. Returns its file.
std::string sizedNetwork() {
  constexpr std::size_t kChannels = 6;
  constexpr std::size_t kFilters = 85;  // a rectangle, its confidence, 80 scores
  constexpr std::size_t kConfidence = 4;
  constexpr std::size_t kPerson = 5;
  constexpr float kCertain = 9.0F;  // before the logistic function
  std::vector<float> biases_and_weights(kFilters + kFilters * kChannels, 0.0F);
  biases_and_weights[kConfidence] = kCertain;
  biases_and_weights[kPerson] = kCertain;
  std::ofstream(newFile(".cfg")) << kSizedNetwork;
  const fs::path model = newFile(".weights");
  std::ofstream out(model, std::ios::binary);
  append(out, std::array<std::int32_t, 5>{0, 2, 0, 0, 0});  // version, images seen
  append(out, biases_and_weights);
  return model.string();
}

DnnDetectorOptions sizedOptions() {
  DnnDetectorOptions options;
  options.model = sizedNetwork();
  options.width = 64;
  options.height = 64;
  options.close_look = 64;
  return options;
}

/// Returns the message of the ModelError; empty: none.
std::string refusalOf(const DnnDetectorOptions& options) {
  try {
    const DnnDetector detector(options);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

void expectAll(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  }
}

TEST(DnnDetector, ANetworkOfSomeSizesDetectsAtThem) {
  DnnDetectorOptions options = sizedOptions();
  for (const int close_look : {0, 64}) {
    options.close_look = close_look;
    DnnDetector detector(options);
    const auto found = detector.detect(cv::Mat(128, 128, CV_8UC1, cv::Scalar(100)), {});
    ASSERT_FALSE(found.empty()) << close_look;
    EXPECT_EQ(found[0].object_class, ObjectClass::kPedestrian);
  }
}

TEST(DnnDetector, ACloseLookOfAnotherSizeIsRefusedAtTheStart) {
  DnnDetectorOptions options = sizedOptions();
  options.close_look = 96;
  expectAll(refusalOf(options),
            {options.model, "an input of 96 x 96 px fails: ", "set dnn/close_look to 0"});
  options.max_close_looks = 0;
  EXPECT_EQ(refusalOf(options), "") << "there is none";
}

TEST(DnnDetector, AnInputOfAnotherSizeIsRefusedAtTheStart) {
  DnnDetectorOptions options = sizedOptions();
  options.width = 96;
  expectAll(refusalOf(options),
            {options.model, "an input of 96 x 64 px fails: ", "set dnn/width and dnn/height"});
}

TEST(DnnDetector, LabelsThatAreMissingOrWithoutRoadUsersAreRefused) {
  DnnDetectorOptions options = sizedOptions();
  options.labels = "/nowhere/labels.txt";
  expectAll(refusalOf(options),
            {"'/nowhere/labels.txt'", "cannot be read", "expected one name per line"});
  options.labels = newFile(".txt").string();
  std::ofstream(options.labels) << "cat\ndog\n\n";
  expectAll(refusalOf(options),
            {options.labels, "2 names, none of a road user", "expected one name per line"});
}

TEST(DnnDetector, AMissingModelIsRefused) {
  DnnDetectorOptions options;
  for (const char* model :
       {"", "/nowhere/network.onnx", "/nowhere/network.weights", "/etc/hosts"}) {
    options.model = model;
    EXPECT_THROW(DnnDetector{options}, ModelError) << model;
  }
}

TEST(DnnDetector, AFileThatIsNotANetworkIsRefused) {
  const fs::path file = fs::path(testing::TempDir()) / "text.onnx";
  std::ofstream(file) << "this is no network";
  DnnDetectorOptions options;
  options.model = file.string();
  EXPECT_THROW(DnnDetector{options}, ModelError);
}

TEST(DnnDetector, InvalidSizesAreRefused) {
  DnnDetectorOptions options;
  options.width = 100;
  EXPECT_THROW(DnnDetector{options}, OptionError);
}

}  // namespace
}  // namespace datmo::dnn_detector_test
