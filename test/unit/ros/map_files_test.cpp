// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/map_files.h"

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

namespace datmo::map_files_test {
namespace {

OccupancyMapOptions smallMap() {
  OccupancyMapOptions options;
  options.window = {40.0, 40.0, 0.5};
  return options;
}

/// Evidence of a wall at x = 4.2 and the free space before it.
OccupancyMap mapWithWall() {
  MapEvidence evidence{0.5, {}};
  for (int row = -6; row < 6; ++row) {
    CellHits hits;
    for (int i = 0; i < 8; ++i) {
      hits.add({-0.05F, 0.02F * static_cast<float>(i - 4)}, 50.0F);
    }
    evidence.cells.push_back({{8, row}, 3.0F, 2.0F, 1, 7, hits});
    for (int column = 0; column < 8; ++column) {
      evidence.cells.push_back({{column, row}, -3.0F, 0.0F, 0, 0, {}});
    }
  }
  return OccupancyMap::restored(smallMap(), evidence);
}

class MapFilesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("map_files_test_" + std::to_string(getpid()) + "_" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(file(name), std::ios::binary).rdbuf();
    return text.str();
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
  }

  /// Returns the message with which a file is refused.
  std::string refusal(const std::string& name,
                      const OccupancyMapOptions& options = smallMap()) const {
    try {
      readMap(file(name), options);
    } catch (const MapFileError& error) {
      return error.what();
    }
    return "it was read";
  }

  static void expectIn(const std::string& part, const std::string& text) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(MapFilesTest, FilesAreReadAsWritten) {
  const OccupancyMap map = mapWithWall();
  EXPECT_EQ(writeMap(file("a.map"), map).cells, 108U);
  const OccupancyMap read = readMap(file("a.map"), smallMap());
  EXPECT_EQ(read.occupancyImage(), map.occupancyImage());
  EXPECT_EQ(read.staticSurfaces().size(), 12U);
  const MapEvidence before = map.evidence();
  const MapEvidence after = read.evidence();
  ASSERT_EQ(after.cells.size(), before.cells.size());
  for (std::size_t i = 0; i < after.cells.size(); ++i) {
    EXPECT_EQ(after.cells[i].cell, before.cells[i].cell);
    EXPECT_EQ(after.cells[i].log_odds, before.cells[i].log_odds);
    EXPECT_EQ(after.cells[i].age, before.cells[i].age);
    EXPECT_EQ(after.cells[i].refuted, before.cells[i].refuted);
    EXPECT_EQ(after.cells[i].believed, before.cells[i].believed);
    EXPECT_EQ(after.cells[i].hits.count, before.cells[i].hits.count);
    EXPECT_EQ(after.cells[i].hits.sum, before.cells[i].hits.sum);
    EXPECT_EQ(after.cells[i].hits.squares, before.cells[i].hits.squares);
  }
}

TEST_F(MapFilesTest, TheSameMapGivesTheSameBytes) {
  writeMap(file("a.map"), mapWithWall());
  writeMap(file("b.map"), mapWithWall());
  EXPECT_EQ(content("a.map"), content("b.map"));
}

TEST_F(MapFilesTest, MapServersFilesShowTheSame) {
  const OccupancyMap map = mapWithWall();
  writeMap(file("a.map"), map);
  expectIn("image: \"a.pgm\"", content("a.yaml"));
  expectIn("resolution: 0.5", content("a.yaml"));
  expectIn("origin: [0, -3, 0.0]", content("a.yaml"));
  const OccupancyMap read = readMap(file("a.yaml"), smallMap());
  for (int row = -8; row < 8; ++row) {
    for (int column = -2; column < 12; ++column) {
      EXPECT_EQ(read.stateOf({column, row}), map.stateOf({column, row})) << column << ", " << row;
    }
  }
}

TEST_F(MapFilesTest, FinerPixelsShowTheSurfaceWithinACell) {
  // 0.1 m, turned by a quarter: the image's x is the map's y.
  write("a.pgm", std::string("P5\n# a comment\n4 5\n255\n") + std::string(4, '\0') +
                     std::string(16, static_cast<char>(254)));
  write("a.yaml",
        "image: a.pgm\nresolution: 0.1\norigin: [0.5, 0.0, 1.5707963267948966]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const OccupancyMap map = readMap(file("a.yaml"), smallMap());
  ASSERT_EQ(map.stateOf({0, 0}), CellState::kStatic);
  EXPECT_NEAR(map.staticSurfaces().front().x(), 0.05, 1e-5);
  EXPECT_NEAR(map.staticSurfaces().front().y(), 0.2, 1e-5);
}

TEST_F(MapFilesTest, ACutOrChangedFileIsRefused) {
  writeMap(file("a.map"), mapWithWall());
  const std::string whole = content("a.map");
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{10}, std::size_t{40}, whole.size() / 2, whole.size() - 1}) {
    write("cut.map", whole.substr(0, size));
    expectIn("cut.map: ", refusal("cut.map"));
    expectIn("expected", refusal("cut.map"));
  }
  std::string changed = whole;
  changed[whole.size() - 100] = static_cast<char>(changed[whole.size() - 100] ^ 1);
  write("changed.map", changed);
  expectIn("its checksum is", refusal("changed.map"));
  write("more.map", whole + "x");
  expectIn("is truncated or modified", refusal("more.map"));
}

TEST_F(MapFilesTest, AMapOfTooManyCellsIsRefusedBeforeItTakesMemory) {
  const std::string header = "datmo_fusion map 1\ncell_size 0.5\ncells 200000000\ncrc32 0\n";
  write("huge.map", header);
  expectIn("0 bytes of cells, expected 48 for each of 200000000", refusal("huge.map"));
  std::filesystem::resize_file(file("huge.map"), header.size() + std::uintmax_t{200'000'000} * 48U);
  expectIn("200000000 cells, expected at most 100000000", refusal("huge.map"));
}

TEST_F(MapFilesTest, AnotherResolutionIsRefused) {
  writeMap(file("a.map"), mapWithWall());
  OccupancyMapOptions finer = smallMap();
  finer.window.cell_size = 0.25;
  expectIn("cells of 0.5 m, expected 0.25 m", refusal("a.map", finer));
  expectIn("a resolution of 0.5 m, expected", refusal("a.yaml", finer));
}

TEST_F(MapFilesTest, FilesThatAreNotMapsAreRefused) {
  expectIn("no such file", refusal("none.map"));
  write("text.map", "hello\n");
  expectIn("not a map of this version", refusal("text.map"));
  write("text.yaml", "hello: [\n");
  expectIn("not a yaml file of map_server", refusal("text.yaml"));
  write("no_image.yaml", "image: none.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
  expectIn("none.pgm: no such file", refusal("no_image.yaml"));
  writeMap(file("a.map"), mapWithWall());
  write("a.pgm", content("a.pgm").substr(0, 60));
  expectIn("a.pgm: is truncated", refusal("a.yaml"));
  write("empty.pgm", std::string("P5 2 2 255\n") + std::string(4, static_cast<char>(205)));
  write("empty.yaml", "image: empty.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
  expectIn("has only unknown cells", refusal("empty.yaml"));
}

TEST_F(MapFilesTest, AFileIsKeptCompletelyWhateverTheLimitOfANewMap) {
  OccupancyMap map = mapWithWall();
  MapEvidence evidence = map.evidence();
  for (int i = 0; i < 5; ++i) {
    evidence.cells.push_back({{100 * (i + 2), 0}, 3.0F, 2.0F, 0, 0, {}});
  }
  writeMap(file("a.map"), OccupancyMap::restored(smallMap(), evidence));
  OccupancyMapOptions small = smallMap();
  small.max_tiles = 4;
  OccupancyMap read = readMap(file("a.map"), small);
  read.setWindow(read.extent());
  EXPECT_EQ(read.evidence().cells.size(), evidence.cells.size());
  EXPECT_EQ(read.forgottenTiles(), 0U);
}

TEST_F(MapFilesTest, ALargeMapHasAnImageOfLargerPixels) {
  MapEvidence evidence{0.5, {}};
  evidence.cells.push_back({{-1, 0}, 3.0F, 2.0F, 0, 0, {}});   // occupied, and in its pixel
  evidence.cells.push_back({{-2, 1}, -3.0F, 0.0F, 0, 0, {}});  // a free cell
  evidence.cells.push_back({{4998, 4999}, -3.0F, 0.0F, 0, 0, {}});
  const SavedMap saved = writeMap(file("a.map"), OccupancyMap::restored(smallMap(), evidence));
  EXPECT_EQ(saved.cells, 3U);
  EXPECT_EQ(saved.cells_of_pixel, 2);
  EXPECT_EQ(readMap(file("a.map"), smallMap()).evidence().cells.size(), 3U);
  expectIn("resolution: 1\norigin: [-1, 0, 0.0]", content("a.yaml"));
  const std::string image = content("a.pgm");
  const std::string header = "P5\n2501 2500\n255\n";
  ASSERT_EQ(image.size(), header.size() + 2501U * 2500U);
  EXPECT_EQ(image.substr(0, header.size()), header);
  const std::string pixels = image.substr(header.size());
  EXPECT_EQ(pixels[2499U * 2501U], 0) << "lower left: one of two cells is occupied";
  EXPECT_EQ(pixels[2500U], static_cast<char>(254)) << "upper right: free";
  EXPECT_EQ(pixels[0], static_cast<char>(205));
}

TEST_F(MapFilesTest, AYamlFileThatIsNotAMapIsNotOverwritten) {
  write("street.yaml", "scanner:\n  range_sigma: 0.1\n");
  try {
    writeMap(file("street.map"), mapWithWall());
    ADD_FAILURE() << "it was written";
  } catch (const MapFileError& error) {
    expectIn("street.yaml would be written beside it", error.what());
  }
  EXPECT_EQ(content("street.yaml"), "scanner:\n  range_sigma: 0.1\n");
  EXPECT_FALSE(std::filesystem::exists(file("street.map")));
  writeMap(file("hall.map"), mapWithWall());
  EXPECT_NO_THROW(writeMap(file("hall.map"), mapWithWall())) << "of the map itself it is";
}

TEST_F(MapFilesTest, AMapOfMapServerHasStaticSurfacesWhateverTheRequiredAge) {
  writeMap(file("a.map"), mapWithWall());
  for (const double age : {0.5, 0.7, 0.8, 0.9, 1.0, 1.3, 1.9}) {
    OccupancyMapOptions options = smallMap();
    options.static_after = age;
    EXPECT_EQ(readMap(file("a.yaml"), options).staticSurfaces().size(), 12U) << age;
  }
}

TEST_F(MapFilesTest, AnImpossibleDescriptionIsRefused) {
  writeMap(file("a.map"), mapWithWall());
  const auto refusalWith = [&](const std::string& lines) {
    write("b.yaml", "image: a.pgm\nresolution: 0.5\n" + lines);
    return refusal("b.yaml");
  };
  expectIn("origin out of range", refusalWith("origin: [.nan, 0, 0]\n"));
  expectIn("origin out of range", refusalWith("origin: [0, 1e12, 0]\n"));
  expectIn("not a yaml file of map_server", refusalWith("origin: [0, 0, 0]\nnegate: true\n"));
  expectIn("not a yaml file of map_server", refusalWith("origin: [0, 0, 0]\nfree_thresh: low\n"));
  expectIn("free_thresh <= occupied", refusalWith("origin: [0, 0, 0]\nfree_thresh: 0.9\n"));
  expectIn("mode raw, expected trinary", refusalWith("origin: [0, 0, 0]\nmode: raw\n"));
  write("b.yaml", "image: /dev/zero\nresolution: 0.5\norigin: [0, 0, 0]\n");
  expectIn("no such file", refusal("b.yaml"));
  expectIn("no such file", refusal(std::string(5000, 'x') + ".map"));
}

TEST_F(MapFilesTest, UnwritableNamesAreRefused) {
  for (const char* name : {"a.yaml", "a.yml", "a.pgm", ".", "none/a.map"}) {
    EXPECT_THROW(writeMap(file(name), mapWithWall()), MapFileError) << name;
  }
}

TEST_F(MapFilesTest, OnAFullDiskOldFilesAreKept) {
  writeMap(file("a.map"), mapWithWall());
  const std::string before = content("a.map");
  // Writing beyond the limit fails as on a full disk.
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{1000, limit.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(writeMap(file("a.map"), mapWithWall()), MapFileError);
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(content("a.map"), before);
  EXPECT_FALSE(std::filesystem::exists(file("a.map.part")));
}

}  // namespace
}  // namespace datmo::map_files_test
