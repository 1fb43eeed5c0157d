// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/fusion/sync/matched_samples.h"
#include "datmo_fusion/fusion/sync/sample_queue.h"

namespace datmo {

struct SourceMatcherOptions {
  std::string reference = "lidar";
  double tolerance = 0.1;     ///< s
  double max_wait = 0.1;      ///< s
  double silent_after = 0.5;  ///< s

  void visit(OptionVisitor& visitor);
};

/// Throws OptionError for a reference that is not one of the sources.
void checkReference(const SourceMatcherOptions& options, const std::vector<std::string>& sources);

/// How many sets a sample may be in.
enum class Serving {
  kOften,  ///< it is the latest of its source until there is a newer one
  kOnce,   ///< it is evidence that must not be counted twice
};

/// Matches samples of several sources that belong together in time. Each sample of the reference
/// source yields one set, as soon as every other live source has published that stamp or a later
/// one, or after `max_wait`. Of each other source the set has the sample nearest in time, the
/// earlier one of two equally near. While the reference is silent, the next live source by name
/// takes its role, until the reference publishes again.
///
/// No set waits for a source with an allowed lateness (a slow detector): its sample goes into the
/// next set after its arrival, if that is within its lateness.
///
/// A sample that serves once is kept for the next set if that one is nearer to it, as far as is
/// known by then.
///
/// Silence counts from a source's last stamp; before its first, from the first stamp of any source.
/// Only data time is used: the output depends on the input alone.
template <typename Payload>
class SourceMatcher {
 public:
  using Matched = MatchedSamples<Payload>;

  /// `sources`: the names of all possible publishers; `late_by`: s, allowed lateness of those that
  /// no set waits for. Throws OptionError.
  SourceMatcher(const Checked<SourceMatcherOptions>& options,
                const std::vector<std::string>& sources, Serving serving,
                const std::map<std::string, double>& late_by = {})
      : options_(*options), serving_(serving) {
    checkReference(*options, sources);
    for (const std::string& source : sources) {
      const auto late = late_by.find(source);
      sources_[source].setLateBy(late == late_by.end() ? 0.0 : late->second);
    }
  }

  /// Throws std::invalid_argument for an unknown source.
  void checkSource(const std::string& source) const;

  /// Adds a sample; one that is not newer than the last of its source is ignored. Throws
  /// std::invalid_argument for an unknown source.
  void add(const std::string& source, Stamp stamp, std::shared_ptr<const Payload> payload);

  /// Returns the next set, by rising stamp; none if nothing is ready. Call it until it returns
  /// none.
  /// `now`: time of the data, the newest stamp that the caller has seen.
  std::optional<Matched> next(Stamp now);

  /// Returns the first waiting set after a stamp (or of all, without one), with the samples
  /// received so far; none if nothing waits. The set keeps waiting: next() returns it later, with
  /// the samples received by then.
  std::optional<Matched> early(std::optional<Stamp> after, Stamp now) const;

  /// Number of samples of a source that were never used in a set and never will be. Throws
  /// std::out_of_range for an unknown source.
  std::uint64_t unserved(const std::string& source) const { return sources_.at(source).unserved(); }

  /// Forgets all samples, as if no source had published since the first stamp.
  void forgetSamples();

  /// Forgets everything except the counts; call it when the clock has jumped back.
  void reset();

 private:
  using Source = SampleQueue<Payload>;
  using Sample = typename Source::Sample;
  using Entry = typename std::map<std::string, Source>::value_type;

  bool isSilent(const Source& source, Stamp now) const {
    return secondsBetween(source.last().value_or(first_.value_or(now)), now) >=
           options_.silent_after;
  }

  /// Whether a sample of this source may be in a set of this stamp.
  bool isNear(const Source& source, Stamp of_sample, Stamp of_set) const {
    const double older = secondsBetween(of_sample, of_set);
    return older >= -options_.tolerance && older <= std::max(source.lateBy(), options_.tolerance);
  }

  /// The source whose samples currently yield sets; null: all are silent.
  Entry* leader(Stamp now);

  /// The source's oldest sample that may yield a set; null if there is none.
  Sample* pending(Source& source) const;

  bool isComplete(Stamp stamp, Stamp now) const;

  /// The source's sample that matches this stamp of the leader; null if there is none.
  Sample* nearest(Source& source, Stamp stamp, Source& leader) const;

  Matched match(Entry& leader, Sample& sample, Stamp now);

  /// Drops the samples that cannot be in any set after this stamp.
  void dropPast(Source& source, Stamp stamp) const;

  SourceMatcherOptions options_;
  Serving serving_;
  std::map<std::string, Source> sources_;
  std::optional<Stamp> first_;    ///< of all samples since the last reset
  std::optional<Stamp> matched_;  ///< of the last set
};

template <typename Payload>
void SourceMatcher<Payload>::checkSource(const std::string& source) const {
  if (sources_.count(source) == 0) {
    throw std::invalid_argument("no source is named " + source);
  }
}

template <typename Payload>
void SourceMatcher<Payload>::add(const std::string& name, Stamp stamp,
                                 std::shared_ptr<const Payload> payload) {
  checkSource(name);
  if (sources_.at(name).add(stamp, std::move(payload)) && !first_) {
    first_ = stamp;
  }
}

template <typename Payload>
std::optional<MatchedSamples<Payload>> SourceMatcher<Payload>::next(Stamp now) {
  Entry* lead = leader(now);
  if (lead == nullptr) {
    return std::nullopt;
  }
  Sample* sample = pending(lead->second);
  if (sample == nullptr || !isComplete(sample->stamp, now)) {
    return std::nullopt;
  }
  matched_ = sample->stamp;
  Matched matched = match(*lead, *sample, now);
  for (auto& [name, source] : sources_) {
    dropPast(source, *matched_);
  }
  return matched;
}

template <typename Payload>
std::optional<MatchedSamples<Payload>> SourceMatcher<Payload>::early(std::optional<Stamp> after,
                                                                     Stamp now) const {
  SourceMatcher impatient = *this;
  impatient.options_.max_wait = 0.0;
  std::optional<Matched> set = impatient.next(now);
  while (set && after && set->stamp() <= *after) {
    set = impatient.next(now);
  }
  return set;
}

template <typename Payload>
void SourceMatcher<Payload>::forgetSamples() {
  for (auto& [name, source] : sources_) {
    source.forget();
  }
}

template <typename Payload>
void SourceMatcher<Payload>::reset() {
  forgetSamples();
  first_.reset();
  matched_.reset();
}

template <typename Payload>
auto SourceMatcher<Payload>::leader(Stamp now) -> Entry* {
  // A waiting sample is used, no matter how old it is.
  const auto leads = [&](Entry& entry) {
    return !isSilent(entry.second, now) || pending(entry.second) != nullptr;
  };
  const auto reference = sources_.find(options_.reference);
  if (leads(*reference)) {
    return &*reference;
  }
  const auto other = std::find_if(sources_.begin(), sources_.end(), leads);
  return other == sources_.end() ? nullptr : &*other;
}

template <typename Payload>
auto SourceMatcher<Payload>::pending(Source& source) const -> Sample* {
  return source.firstAfter(matched_, serving_ == Serving::kOnce);
}

template <typename Payload>
bool SourceMatcher<Payload>::isComplete(Stamp stamp, Stamp now) const {
  return secondsBetween(stamp, now) >= options_.max_wait ||
         std::all_of(sources_.begin(), sources_.end(), [&](const Entry& entry) {
           const Source& source = entry.second;
           return source.lateBy() > 0.0 || isSilent(source, now) ||
                  (source.last() && *source.last() >= stamp);
         });
}

template <typename Payload>
auto SourceMatcher<Payload>::nearest(Source& source, Stamp stamp, Source& leader) const -> Sample* {
  std::optional<Stamp> next;
  if (serving_ == Serving::kOnce) {
    const Sample* const after = leader.firstAfter(stamp, false);
    next = after == nullptr ? std::nullopt : std::optional<Stamp>(after->stamp);
  }
  Sample* const found = source.nearest(stamp, next);
  return found != nullptr && isNear(source, found->stamp, stamp) ? found : nullptr;
}

template <typename Payload>
MatchedSamples<Payload> SourceMatcher<Payload>::match(Entry& leader, Sample& sample, Stamp now) {
  Matched matched;
  const auto serve = [&matched](const std::string& name, Sample& one) {
    one.served = true;
    matched.samples.push_back({name, one.stamp, one.payload});
  };
  serve(leader.first, sample);
  for (auto& [name, source] : sources_) {
    if (name == leader.first) {
      continue;
    }
    if (Sample* const other = nearest(source, sample.stamp, leader.second)) {
      serve(name, *other);
    } else {
      matched.missing.push_back(
          {name, isSilent(source, now) ? WhyMissing::kSilent : WhyMissing::kNoneNear});
    }
  }
  return matched;
}

template <typename Payload>
void SourceMatcher<Payload>::dropPast(Source& source, Stamp stamp) const {
  source.dropWhile(
      [&](Stamp of_sample) { return of_sample < stamp && !isNear(source, of_sample, stamp); });
  if (serving_ == Serving::kOnce) {
    source.dropUpToServed();
  }
}

}  // namespace datmo
