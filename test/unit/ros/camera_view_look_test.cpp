// SPDX-License-Identifier: BSD-3-Clause
// Drawing of a track in the camera's image: its existence probability, and its class.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <vector>

#include "camera_view_sample.h"

namespace datmo::camera_view_test {
namespace {

TEST_F(CameraViewTest, AnUncertainTrackIsFainter) {
  view_.handleCameraInfo(cameraInfo());
  const auto strength = [this](double seconds, float existence) {
    mountCamera(seconds);
    const auto list = tracks(seconds, 12.0, 0.0);
    list->tracks[0].existence_probability = existence;
    view_.handleTracks(list);
    const auto picture = show(image(seconds));
    int sum = 0;  // over the middle of the box's rear
    for (std::size_t i = 0; picture && i < 3 * std::size_t{kWidth}; ++i) {
      sum += std::abs(picture->data[270 * picture->step + i] - kGray);
    }
    return sum;
  };
  const int sure = strength(kStart, 1.0F);
  const int unsure = strength(kStart + 0.1, 0.0F);
  EXPECT_GT(unsure, 0);
  EXPECT_LT(2 * unsure, sure);
}

TEST_F(CameraViewTest, EachClassHasAnIcon) {
  view_.handleCameraInfo(cameraInfo());
  std::set<std::vector<std::uint8_t>> icons;
  double seconds = kStart;
  for (const auto one : {ObjectMessage::CLASS_PEDESTRIAN, ObjectMessage::CLASS_CYCLIST,
                         ObjectMessage::CLASS_VEHICLE, ObjectMessage::CLASS_POLE}) {
    seconds += 0.1;
    mountCamera(seconds);
    const auto list = tracks(seconds, 12.0, 0.0);
    list->tracks[0].classification = one;
    list->tracks[0].existence_probability = 1.0F;
    view_.handleTracks(list);
    const auto picture = show(image(seconds));
    ASSERT_TRUE(picture);
    std::vector<std::uint8_t> white;  // of the label's left end: letters and icons
    for (int row = 210; row < 240; ++row) {
      for (int column = 280; column < 300; ++column) {
        const std::size_t at =
            static_cast<std::size_t>(row) * picture->step + 3 * static_cast<std::size_t>(column);
        white.push_back(*std::min_element(&picture->data[at], &picture->data[at] + 3) / 128);
      }
    }
    icons.insert(white);
  }
  EXPECT_EQ(icons.size(), 4U);
}

}  // namespace
}  // namespace datmo::camera_view_test
