// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/matches_json.h"

#include "evaluate/made_frames.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::matches_json_test {
namespace {

using nlohmann::json;

json framesOf(const Frames& frames) {
  RunScore score;
  score.frames = frames;
  score.tracks = scoreTracks(frames, {});
  const json report = matchesJson(score, {});
  EXPECT_EQ(report["format"], 1);
  return report["frames"];
}

TEST(MatchesJson, HasTheMatchOfEachObjectAndTrack) {
  const json frames =
      framesOf(FrameMaker()
                   .add({}, {})
                   .add({truthAt(1, 0.0), truthAt(2, 50.0), optionalAt(3, 20.0)},
                        {trackAt(7, 0.5), trackAt(8, 20.0), trackAt(9, 21.0), trackAt(10, 80.0)})
                   .frames());
  ASSERT_EQ(frames.size(), 2U);
  const json& frame = frames[1];
  EXPECT_EQ(frame["stamp_ns"], 1000000000);
  EXPECT_EQ(frame["matches"].size(), 2U);
  EXPECT_EQ(frame["matches"][0],
            json({{"truth_id", 1}, {"track_id", 7}, {"distance_m", 0.5}, {"required", true}}));
  EXPECT_EQ(frame["matches"][1],
            json({{"truth_id", 3}, {"track_id", 8}, {"distance_m", 0.0}, {"required", false}}));
  EXPECT_EQ(frame["missed"], json({2}));
  EXPECT_EQ(frame["false"], json({10}));
  EXPECT_EQ(frame["neutral"], json({8, 9}));
  for (const char* list : {"matches", "missed", "false", "neutral", "switches"}) {
    EXPECT_EQ(frames[0][list], json::array()) << list;
  }
}

TEST(MatchesJson, NamesTheObjectThatChangesItsTrack) {
  const json frames = framesOf(followedBy({7, 0, 8, 8}));
  EXPECT_EQ(frames[2]["switches"], json({{{"truth_id", 1}, {"from", 7}, {"to", 8}}}));
  for (const std::size_t without : {0, 1, 3}) {
    EXPECT_TRUE(frames[without]["switches"].empty()) << without;
  }
}

}  // namespace
}  // namespace datmo::evaluation::matches_json_test
