#include "datmo_fusion/fusion/grid_matcher.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace datmo {

namespace {

/// Of each source, so that no rate fills the memory; at 50 Hz those of more than a second.
constexpr std::size_t kMostGrids = 64;

std::string describe(const GridWindow& window) {
  return std::to_string(window.columns) + " x " + std::to_string(window.rows) + " cells of " +
         toText(OptionValue(window.cell_size)) + " m from cell (" +
         std::to_string(window.corner.column) + ", " + std::to_string(window.corner.row) + ")";
}

}  // namespace

void GridMatcherOptions::visit(OptionVisitor& visitor) {
  visitor.text({"reference", "",
                "source whose grids set the stamps of the fused ones; while it is silent, the next "
                "one by name does"},
               reference, {});
  visitor.number({"tolerance", "s", "grids this near in time are fused with the reference's"},
                 tolerance, {0.0, 1.0});
  visitor.number({"longest_wait", "s", "a grid of the reference waits for the others' at most"},
                 longest_wait, {0.0, 1.0});
  visitor.number({"silent_after", "s", "a source that says nothing for as long is not waited for"},
                 silent_after, {0.05, 10.0});
}

const char* toText(WhyMissing why) {
  switch (why) {
    case WhyMissing::kSilent:
      return "silent";
    case WhyMissing::kNoneNear:
      return "none near";
    case WhyMissing::kNoMotion:
      return "no motion";
  }
  return "";
}

GridMatcher::GridMatcher(const GridMatcherOptions& options, const std::vector<std::string>& sources)
    : options_(options) {
  checkOptions(options);
  std::string names;
  for (const std::string& source : sources) {
    sources_[source];
    names += (names.empty() ? "" : ", ") + source;
  }
  if (sources_.count(options.reference) == 0) {
    throw OptionError("reference = \"" + options.reference + "\": expected one of the sources (" +
                      names + ")");
  }
}

void GridMatcher::reset() {
  for (auto& [name, source] : sources_) {
    source.grids.clear();
  }
  window_.reset();
  first_.reset();
  matched_.reset();
}

void GridMatcher::checkWindow(const std::string& source, const GridWindow& window) {
  if (window_ && *window_ != window) {
    if (source != options_.reference) {
      throw WrongWindowError("window of " + source + ": " + describe(window) +
                             ", expected as the other grids have it: " + describe(*window_));
    }
    for (auto& [name, other] : sources_) {
      other.grids.clear();
    }
  }
  window_ = window;
}

void GridMatcher::add(const std::string& source, SensorGrid grid) {
  const auto entry = sources_.find(source);
  if (entry == sources_.end()) {
    throw std::invalid_argument("no source of grids is named " + source);
  }
  checkWindow(source, grid.window());
  auto& grids = entry->second.grids;
  if (!grids.empty() && grid.stamp() <= grids.back()->stamp()) {
    return;
  }
  if (!first_) {
    first_ = grid.stamp();
  }
  grids.push_back(std::make_shared<const SensorGrid>(std::move(grid)));
  if (grids.size() > kMostGrids) {
    grids.pop_front();
  }
}

bool GridMatcher::isSilent(const Source& source, Stamp now) const {
  const Stamp last = source.grids.empty() ? first_.value_or(now) : source.grids.back()->stamp();
  return secondsBetween(last, now) >= options_.silent_after;
}

std::shared_ptr<const SensorGrid> GridMatcher::pending(const Source& source) const {
  for (const auto& grid : source.grids) {
    if (!matched_ || *matched_ < grid->stamp()) {
      return grid;
    }
  }
  return nullptr;
}

const GridMatcher::Entry* GridMatcher::leader(Stamp now) const {
  // What waits is served, however long ago it was said.
  const auto leads = [&](const Entry& entry) {
    return !isSilent(entry.second, now) || pending(entry.second) != nullptr;
  };
  const auto reference = sources_.find(options_.reference);
  if (leads(*reference)) {
    return &*reference;
  }
  const auto other = std::find_if(sources_.begin(), sources_.end(), leads);
  return other == sources_.end() ? nullptr : &*other;
}

bool GridMatcher::isComplete(Stamp stamp, Stamp now) const {
  if (secondsBetween(stamp, now) >= options_.longest_wait) {
    return true;
  }
  return std::all_of(sources_.begin(), sources_.end(), [&](const Entry& entry) {
    const auto& grids = entry.second.grids;
    return isSilent(entry.second, now) || (!grids.empty() && grids.back()->stamp() >= stamp);
  });
}

MatchedGrids GridMatcher::match(const Entry& leader, std::shared_ptr<const SensorGrid> grid,
                                Stamp now) const {
  const Stamp stamp = grid->stamp();
  const auto distance = [stamp](const std::shared_ptr<const SensorGrid>& other) {
    return std::abs(secondsBetween(stamp, other->stamp()));
  };
  MatchedGrids matched;
  matched.grids.push_back({leader.first, std::move(grid)});
  for (const auto& [name, source] : sources_) {
    if (name == leader.first) {
      continue;
    }
    const auto nearest =
        std::min_element(source.grids.begin(), source.grids.end(),
                         [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    if (nearest != source.grids.end() && distance(*nearest) <= options_.tolerance) {
      matched.grids.push_back({name, *nearest});
    } else {
      matched.missing.push_back(
          {name, isSilent(source, now) ? WhyMissing::kSilent : WhyMissing::kNoneNear});
    }
  }
  return matched;
}

std::optional<MatchedGrids> GridMatcher::next(Stamp now) {
  const Entry* lead = leader(now);
  if (lead == nullptr) {
    return std::nullopt;
  }
  std::shared_ptr<const SensorGrid> grid = pending(lead->second);
  if (!grid || !isComplete(grid->stamp(), now)) {
    return std::nullopt;
  }
  matched_ = grid->stamp();
  return match(*lead, std::move(grid), now);
}

}  // namespace datmo
