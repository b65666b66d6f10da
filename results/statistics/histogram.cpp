#include "results/statistics/histogram.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

namespace ridgeloc::results {
namespace {

constexpr int bits_below_bin = 52 - 5;  // of the mantissa, whose five leading bits choose the bin within an octave
static_assert(Histogram::bins_per_octave == 1U << 5U);

/// Values whose slots are chosen at a time.
constexpr std::size_t piece = 1024;

/// Number of the bin where the sign is positive; below zero where it is negative. The upper half of a double decides,
/// and 32-bit numbers suffice for it, which compilers turn into vector code.
[[gnu::always_inline]] inline std::int32_t signed_bin_of(double value) {
  const auto upper_half = static_cast<std::int32_t>(std::bit_cast<std::uint64_t>(value) >> 32);
  return upper_half >> (bits_below_bin - 32);
}

/// The bins of all values but those of bin 0 and the infinite ones.
struct Window {
  std::int32_t first = Histogram::infinite_bin;
  std::int32_t last = 0;

  /// Of a sample without any it is zero.
  std::int32_t width() const { return std::max(last - first + 1, 0); }
};

template <std::size_t>
struct FindWindow {
  [[gnu::always_inline]] static Window run(std::span<const double> values) {
    constexpr std::int32_t infinite = Histogram::infinite_bin;
    Window window;
    for (const double value : values) {
      const std::int32_t bin = signed_bin_of(value);
      window.first = bin > 0 && bin < window.first ? bin : window.first;
      window.last = bin < infinite && bin > window.last ? bin : window.last;
    }
    return window;
  }
};

/// Most samples have neither zeros nor infinite values, and their extremes say it all.
Window window_of(std::span<const double> values, const Extremes& extremes, InstructionSet set) {
  const std::uint32_t first = Histogram::bin_of(extremes.min);
  const std::uint32_t last = Histogram::bin_of(extremes.max);
  if (first == 0 || last == Histogram::infinite_bin) return run_with<FindWindow>(set, values);
  return {static_cast<std::int32_t>(first), static_cast<std::int32_t>(last)};
}

/// The place of each value in a tally: 0 for bin 0, from 1 on the bins of the window, then infinite values, then NaN,
/// which keeps the loops free of branches.
template <std::size_t>
struct ChooseSlots {
  [[gnu::always_inline]] static void run(std::span<const double> values, const Window& window, std::uint16_t* slots) {
    const std::int32_t before = window.first - 1;
    const std::int32_t infinite = window.width() + 1;
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::int32_t slot = signed_bin_of(values[i]) - before;
      slot = slot < 0 ? 0 : slot;
      slot = slot > infinite ? infinite : slot;
      slot = values[i] == values[i] ? slot : infinite + 1;
      slots[i] = static_cast<std::uint16_t>(slot);
    }
  }
};

/// Counts per slot, in tables that take turns: runs of equal values (iteration counts) would otherwise wait for their
/// own last increment.
class Tally {
 public:
  explicit Tally(const Window& window)
      : window_(window), size_(static_cast<std::size_t>(window.width()) + 3), counts_(tables * size_) {}

  void add(std::span<const std::uint16_t> slots) {
    const std::size_t whole = slots.size() / tables * tables;
    for (std::size_t i = 0; i < whole; i += tables) {
      for (std::size_t t = 0; t < tables; ++t) ++counts_[t * size_ + slots[i + t]];
    }
    for (std::size_t i = whole; i < slots.size(); ++i) ++counts_[slots[i]];
  }

  std::vector<Histogram::Bin> bins() const {
    std::vector<Histogram::Bin> bins;
    const auto append = [&](std::uint32_t number, std::size_t slot) {
      std::uint64_t count = 0;
      for (std::size_t t = 0; t < tables; ++t) count += counts_[t * size_ + slot];
      if (count > 0) bins.push_back({number, count});
    };
    append(0, 0);
    const std::size_t infinite = size_ - 2;
    for (std::size_t slot = 1; slot < infinite; ++slot)
      append(static_cast<std::uint32_t>(window_.first) + static_cast<std::uint32_t>(slot) - 1, slot);
    append(Histogram::infinite_bin, infinite);
    return bins;
  }

 private:
  static constexpr std::size_t tables = 4;

  Window window_;
  std::size_t size_;  ///< of a table
  std::vector<std::uint32_t> counts_;
};

}  // namespace

Histogram::Histogram(std::vector<Bin> bins) : bins_(std::move(bins)) {
  const bool ascends = std::ranges::adjacent_find(bins_, std::ranges::greater_equal{}, &Bin::number) == bins_.end();
  const bool is_on_grid = bins_.empty() || bins_.back().number <= infinite_bin;
  if (!ascends || !is_on_grid || std::ranges::find(bins_, 0U, &Bin::count) != bins_.end())
    throw std::invalid_argument("Histogram: bins are empty, out of order or outside the grid");
}

std::uint32_t Histogram::bin_of(double value) {
  return static_cast<std::uint32_t>(std::max(signed_bin_of(value), 0));
}

double Histogram::lower_edge(std::uint32_t bin) {
  if (bin >= infinite_bin) return std::numeric_limits<double>::infinity();
  return std::bit_cast<double>(std::uint64_t{bin} << bits_below_bin);
}

void Histogram::add(std::span<const double> values, const Extremes& extremes, InstructionSet set) {
  constexpr std::size_t largest_count = std::numeric_limits<std::uint32_t>::max();
  if (values.size() > largest_count) {
    const std::span<const double> head = values.first(largest_count);
    const std::span<const double> rest = values.subspan(largest_count);
    add(head, extremes_of(head, set), set);
    return add(rest, extremes_of(rest, set), set);
  }
  if (!(extremes.min <= extremes.max)) return;  // nothing but NaN
  const Window window = window_of(values, extremes, set);
  Tally tally(window);
  std::array<std::uint16_t, piece> slots;
  for (std::size_t i = 0; i < values.size(); i += piece) {
    const std::span<const double> part = values.subspan(i, std::min(piece, values.size() - i));
    run_with<ChooseSlots>(set, part, window, slots.data());
    tally.add(std::span(slots).first(part.size()));
  }
  merge(Histogram(tally.bins()));
}

void Histogram::merge(const Histogram& other) {
  if (bins_.empty()) {
    bins_ = other.bins_;
    return;
  }
  std::vector<Bin> both;
  both.reserve(bins_.size() + other.bins_.size());
  std::ranges::merge(bins_, other.bins_, std::back_inserter(both), {}, &Bin::number, &Bin::number);
  bins_.clear();
  for (const Bin& bin : both) {
    if (!bins_.empty() && bins_.back().number == bin.number) {
      bins_.back().count += bin.count;
    } else {
      bins_.push_back(bin);
    }
  }
}

std::uint64_t Histogram::count_in(std::uint32_t bin) const {
  const auto found = std::ranges::lower_bound(bins_, bin, {}, &Bin::number);
  return found != bins_.end() && found->number == bin ? found->count : 0;
}

std::uint64_t Histogram::total() const {
  std::uint64_t sum = 0;
  for (const Bin& bin : bins_) sum += bin.count;
  return sum;
}

double Histogram::quantile(double q, const Range& range) const {
  if (bins_.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double target = std::clamp(q, 0.0, 1.0) * static_cast<double>(total());
  std::uint64_t below = 0;
  auto bin = bins_.begin();
  while (std::next(bin) != bins_.end() && static_cast<double>(below + bin->count) < target) {
    below += bin->count;
    ++bin;
  }
  if (bin->number == infinite_bin) return std::numeric_limits<double>::infinity();
  const double low = std::max(lower_edge(bin->number), range.min);
  const double high = std::min({lower_edge(bin->number + 1), range.max, std::numeric_limits<double>::max()});
  const double share = (target - static_cast<double>(below)) / static_cast<double>(bin->count);
  return low + std::clamp(share, 0.0, 1.0) * (high - low);
}

}  // namespace ridgeloc::results
