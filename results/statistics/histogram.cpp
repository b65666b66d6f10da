#include "results/statistics/histogram.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace ridgeloc::results {
namespace {

constexpr int mantissa_bits = 52;
constexpr int bin_bits = 5;  // leading mantissa bits that choose the bin within an octave
static_assert(Histogram::bins_per_octave == 1 << bin_bits);
constexpr int exponent_bias = 1023;

/// Exponent and leading mantissa bits of the lower edge of bin 1.
constexpr std::int64_t lowest_key = (exponent_bias + Histogram::lowest_octave) * Histogram::bins_per_octave;

/// The sign bit makes the key of a negative value negative, so that it falls into bin 0.
std::int64_t key_of(double value) {
  return std::bit_cast<std::int64_t>(value) >> (mantissa_bits - bin_bits);
}

/// One more slot than bins takes the NaN, which keeps the loops free of branches.
constexpr std::uint16_t nan_slot = Histogram::bins;

/// Values whose slots are chosen at a time.
constexpr std::size_t piece = 1024;

/// `Histogram::bin_of`, or `nan_slot`, of each value. The upper half of a double decides, and 32-bit numbers suffice
/// for it, which compilers turn into vector code.
template <std::size_t>
struct ChooseSlots {
  [[gnu::always_inline]] static void run(std::span<const double> values, std::uint16_t* slots) {
    constexpr std::int32_t last_bin = Histogram::bins - 1;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto upper_half = static_cast<std::int32_t>(std::bit_cast<std::uint64_t>(values[i]) >> 32);
      std::int32_t bin = (upper_half >> (mantissa_bits - bin_bits - 32)) - static_cast<std::int32_t>(lowest_key) + 1;
      bin = bin < 0 ? 0 : bin;
      bin = bin > last_bin ? last_bin : bin;
      bin = values[i] == values[i] ? bin : nan_slot;
      slots[i] = static_cast<std::uint16_t>(bin);
    }
  }
};

/// Counts per slot, in tables that take turns: runs of equal values (iteration counts) would otherwise wait for their
/// own last increment. Only the bins in use are ever touched.
class Tally {
 public:
  Tally(std::uint32_t first, std::uint32_t end) {
    for (Table& table : tables_) {
      std::fill(table.begin() + first, table.begin() + end, 0);
      table[nan_slot] = 0;
    }
  }

  void add(std::span<const std::uint16_t> slots) {
    const std::size_t whole = slots.size() / tables_.size() * tables_.size();
    for (std::size_t i = 0; i < whole; i += tables_.size()) {
      for (std::size_t t = 0; t < tables_.size(); ++t) ++tables_[t][slots[i + t]];
    }
    for (std::size_t i = whole; i < slots.size(); ++i) ++tables_[0][slots[i]];
  }

  std::vector<std::uint64_t> counts(std::uint32_t first, std::uint32_t end) const {
    std::vector<std::uint64_t> counts(end - first);
    for (const Table& table : tables_) {
      for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += table[first + i];
    }
    return counts;
  }

 private:
  using Table = std::array<std::uint32_t, Histogram::bins + 1>;
  std::array<Table, 4> tables_;
};

}  // namespace

Histogram::Histogram(std::uint32_t first_bin, std::vector<std::uint64_t> counts)
    : first_bin_(first_bin), counts_(std::move(counts)) {
  if (first_bin_ > bins || counts_.size() > bins - first_bin_) {
    throw std::invalid_argument("Histogram: the counts reach beyond the last bin");
  }
}

std::uint32_t Histogram::bin_of(double value) {
  return static_cast<std::uint32_t>(
      std::clamp<std::int64_t>(key_of(value) - lowest_key + 1, 0, std::int64_t{bins} - 1));
}

double Histogram::lower_edge(std::uint32_t bin) {
  if (bin == 0) return 0.0;
  if (bin >= bins) return std::numeric_limits<double>::infinity();
  return std::bit_cast<double>((lowest_key + bin - 1) << (mantissa_bits - bin_bits));
}

void Histogram::add(std::span<const double> values, const Extremes& extremes, InstructionSet set) {
  constexpr std::size_t largest_count = std::numeric_limits<std::uint32_t>::max();
  if (values.size() > largest_count) {
    add(values.first(largest_count));
    return add(values.subspan(largest_count));
  }
  if (!(extremes.min <= extremes.max)) return;  // nothing but NaN
  const std::uint32_t first = bin_of(extremes.min);
  const std::uint32_t end = bin_of(extremes.max) + 1;
  Tally tally(first, end);
  std::array<std::uint16_t, piece> slots;
  for (std::size_t i = 0; i < values.size(); i += piece) {
    const std::span<const double> part = values.subspan(i, std::min(piece, values.size() - i));
    run_with<ChooseSlots>(set, part, slots.data());
    tally.add(std::span(slots).first(part.size()));
  }
  std::vector<std::uint64_t> counts = tally.counts(first, end);
  if (counts_.empty()) {
    first_bin_ = first;
    counts_ = std::move(counts);
  } else {
    merge(Histogram(first, std::move(counts)));
  }
}

void Histogram::merge(const Histogram& other) {
  if (other.counts_.empty()) return;
  if (counts_.empty()) {
    *this = other;
    return;
  }
  const std::size_t first = std::min(first_bin_, other.first_bin_);
  const std::size_t end = std::max(first_bin_ + counts_.size(), other.first_bin_ + other.counts_.size());
  counts_.insert(counts_.begin(), first_bin_ - first, 0);
  counts_.resize(end - first, 0);
  first_bin_ = static_cast<std::uint32_t>(first);
  const std::size_t offset = other.first_bin_ - first;
  for (std::size_t i = 0; i < other.counts_.size(); ++i) counts_[offset + i] += other.counts_[i];
}

std::uint64_t Histogram::total() const {
  std::uint64_t sum = 0;
  for (const std::uint64_t count : counts_) sum += count;
  return sum;
}

double Histogram::quantile(double q) const {
  const std::uint64_t n = total();
  if (n == 0) return std::numeric_limits<double>::quiet_NaN();
  const double target = std::clamp(q, 0.0, 1.0) * static_cast<double>(n);
  std::uint64_t below = 0;
  std::size_t bin = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i] == 0) continue;
    bin = i;
    if (static_cast<double>(below + counts_[i]) >= target) break;
    below += counts_[i];
  }
  const std::uint32_t index = first_bin_ + static_cast<std::uint32_t>(bin);
  if (index == bins - 1) return std::numeric_limits<double>::infinity();
  const double low = lower_edge(index);
  const double share = (target - static_cast<double>(below)) / static_cast<double>(counts_[bin]);
  return low + std::clamp(share, 0.0, 1.0) * (lower_edge(index + 1) - low);
}

}  // namespace ridgeloc::results
