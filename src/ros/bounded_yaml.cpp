// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/bounded_yaml.h"

#include <cstddef>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include <yaml-cpp/eventhandler.h>

namespace datmo {

namespace {

// Same limits as in tools/datmo_tools/yaml_files.py; the package's largest file has a hundredth.
constexpr std::size_t kMaxBytes = 1U << 20U;
constexpr std::size_t kMaxDepth = 100;
constexpr std::size_t kMaxNodes = 100'000;  // aliases count with their expansion

const char* const kNoFile = ": expected a yaml file that can be read";

/// Receives the parser's events, and throws YAML::ParserException if a limit is exceeded.
class SizeCheck : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { addLeaf(mark, anchor); }
  void OnScalar(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                const std::string& /*value*/) override {
    addLeaf(mark, anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open(mark, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open(mark, anchor);
  }
  void OnMapEnd() override { close(); }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto meant = nodes_of_.find(anchor);
    if (meant == nodes_of_.end()) {
      throw YAML::ParserException(mark, "an alias stands for what it stands in");
    }
    add(mark, meant->second);
  }

 private:
  struct Open {
    YAML::anchor_t anchor;
    std::size_t nodes_before;
  };

  void add(const YAML::Mark& mark, std::size_t nodes) {
    nodes_ += nodes;
    if (nodes_ > kMaxNodes) {
      throw YAML::ParserException(mark, "there are more than " + std::to_string(kMaxNodes) +
                                            " values, including those of aliases");
    }
  }

  void addLeaf(const YAML::Mark& mark, YAML::anchor_t anchor) {
    add(mark, 1);
    nodes_of_[anchor] = 1;
  }

  void open(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (open_.size() == kMaxDepth) {
      throw YAML::ParserException(
          mark, "lists and maps are nested more than " + std::to_string(kMaxDepth) + " deep");
    }
    open_.push_back({anchor, nodes_});
    add(mark, 1);
  }

  void close() {
    nodes_of_[open_.back().anchor] = nodes_ - open_.back().nodes_before;
    open_.pop_back();
  }

  std::size_t nodes_ = 0;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, std::size_t> nodes_of_;  ///< number of nodes of each completed anchor
};

}  // namespace

YAML::Node parseYaml(const std::string& name, const std::string& text) {
  try {
    std::istringstream stream(text);
    SizeCheck check;
    YAML::Parser(stream).HandleNextDocument(check);
    return YAML::Load(text);
  } catch (const YAML::ParserException& error) {
    throw YamlError(name + ":" + std::to_string(error.mark.line + 1) + ": expected yaml, but " +
                    error.msg);
  }
}

YAML::Node loadYamlFile(const std::string& file) {
  // A pipe has no size, and a device has no end.
  std::ifstream stream(file, std::ios::binary);
  std::string text(kMaxBytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream.eof() && !stream.good()) {  // missing, or a directory
    throw YamlError(file + kNoFile);
  }
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > kMaxBytes) {
    throw YamlError(file + ": expected yaml, but it has more than " + std::to_string(kMaxBytes) +
                    " bytes");
  }
  return parseYaml(file, text);
}

}  // namespace datmo
