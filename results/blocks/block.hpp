#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "results/blocks/failure_list.hpp"
#include "results/blocks/ledger.hpp"
#include "results/schema/schema.hpp"
#include "results/util/digest.hpp"

namespace ridgeloc::results {

/// How many trials of a block of `trials` trials, the first of it, have their values kept.
std::uint64_t kept_trials(const Header& header, std::uint64_t block, std::uint64_t trials);

/// The values of each trial of one block that is kept, for one method.
struct TrialColumns {
  std::size_t cell = 0;
  std::size_t method = 0;
  std::uint64_t block = 0;
  std::uint64_t trials = 0;                  ///< kept ones, the first of the block
  std::vector<std::uint8_t> status;          ///< empty: the method reports none
  std::vector<std::vector<double>> metrics;  ///< per `Schema::metrics`; empty: not given

  /// Approximate memory in use.
  std::size_t bytes() const;
  /// Of the values alone, which is what they take in a file.
  std::size_t value_bytes() const;

  friend bool operator==(const TrialColumns&, const TrialColumns&) = default;
};

/// Which methods of a block are wanted, as the experiment that computes it numbers them.
struct BlockMethods {
  /// Stands for a method whose columns are wanted for differences at most.
  static constexpr std::size_t unwanted = static_cast<std::size_t>(-1);

  /// The difference of two methods.
  struct Difference {
    std::size_t number;  ///< in the header
    std::size_t minuend;
    std::size_t subtrahend;
  };

  std::vector<std::size_t> numbers;  ///< in the header, or `unwanted`
  std::vector<Difference> differences;
};

/// All methods of a study, its solvers and extra labels first and in their order.
BlockMethods all_methods(const Header& header);

/// Takes the columns of one block of one cell from an experiment and reduces each at once.
///
/// Methods are numbered as the experiment that fills the sink numbers them, which need not be all that the study has.
/// Columns hold one value per trial, in trial order. A method may give any of them, each at most once; one
/// that gives neither statuses nor events (a bound that belongs to the scene, say) reports no events. The
/// digest of a method covers its columns in the order given, which must therefore not vary. Misuse throws
/// std::invalid_argument. One thread at a time per object.
class BlockSink {
 public:
  /// `methods`: those that will give columns. Precondition: cell and trials are in range, and so are methods, events
  /// and metrics in the calls below.
  BlockSink(const Header& header, std::size_t cell, std::uint64_t block, std::uint64_t trials, BlockMethods methods);
  /// For all methods of the header.
  BlockSink(const Header& header, std::size_t cell, std::uint64_t block, std::uint64_t trials)
      : BlockSink(header, cell, block, trials, all_methods(header)) {}

  /// Status codes; counted as the status events that open the schema.
  void status(std::size_t method, std::span<const std::uint8_t> codes);
  /// Zero or one per trial. Precondition: `event` is not a status.
  void event(std::size_t method, std::size_t event, std::span<const std::uint8_t> flags);
  /// NaN: the trial is not in the metric's population.
  void metric(std::size_t method, std::size_t metric, std::span<const double> values);
  /// A metric whose population is a few trials at most: values[i] of trial trials[i], ascending and counted from the
  /// first of the block.
  void sparse_metric(std::size_t method, std::size_t metric, std::span<const std::size_t> trials,
                     std::span<const double> values);

  std::size_t cell() const { return cell_; }
  std::uint64_t block() const { return block_; }
  std::uint64_t trials() const { return trials_; }

  /// The finished block: one row per wanted method. Empties the sink.
  std::vector<Row> take_rows();
  /// The columns of the trials that the study keeps, of methods that gave any. Empties the sink.
  std::vector<TrialColumns> take_columns();
  /// The first trials that failed in the block, by method and reason. Empties the sink.
  FailureList take_failures();

 private:
  struct PerMethod {
    std::size_t number = 0;  ///< in the header
    Statistics statistics;
    Digest64 digest;
    TrialColumns columns;
    bool has_columns = false;
    bool is_compared = false;
    std::vector<std::vector<double>> compared;  ///< per metric; empty: not given, or not compared
  };

  PerMethod& begin_column(std::size_t method, std::uint64_t kind, std::size_t index, std::span<const std::byte> bytes,
                          std::size_t values);
  std::vector<std::uint64_t>& events_of(PerMethod& method) const;
  Row difference_row(const BlockMethods::Difference& difference) const;
  void note_failures(const PerMethod& method, std::span<const std::uint8_t> codes);
  template <class SlotOf>
  void note_alarms(const PerMethod& method, std::size_t metric, std::span<const double> values, SlotOf&& slot_of);

  static constexpr std::size_t no_reason = static_cast<std::size_t>(-1);

  std::size_t cell_;
  std::uint64_t block_;
  std::uint64_t trials_;
  std::uint64_t first_trial_;
  std::size_t events_;
  std::size_t statuses_;
  std::vector<std::size_t> status_reason_;  ///< per status; `no_reason`: no failure
  std::vector<std::size_t> metric_reason_;  ///< per metric, likewise
  std::size_t kept_;                        ///< trials whose values are kept
  std::vector<std::uint8_t> is_compared_;   ///< per metric
  std::vector<PerMethod> methods_;
  std::vector<BlockMethods::Difference> differences_;
  FailureList failures_;
};

}  // namespace ridgeloc::results
