#include "studies/measured/fix_writer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ostream>

#include "core/error.hpp"
#include "core/status.hpp"
#include "results/util/json.hpp"

namespace ridgeloc::studies {

namespace {

constexpr std::array<const char*, 6> covariance_names = {"cov_xx_m2", "cov_xy_m2", "cov_xz_m2",
                                                         "cov_yy_m2", "cov_yz_m2", "cov_zz_m2"};

constexpr const char* note_of_unsettled = "unsettled";

/// What a user must know of an answer.
std::string note_of(const EpochGeometry& geometry, const Fix& fix) {
  std::string note = geometry.note;
  if (fix.status == core::status_names[0] && !fix.is_settled)
    note += fmt::format("{}{}", note.empty() ? "" : " ", note_of_unsettled);
  return note;
}

/// What a reading is called: its object, or its number from 1.
std::string name_of_reading(const Epoch& epoch, std::size_t j) {
  return epoch.readings[j].object.empty() ? std::to_string(j + 1) : epoch.readings[j].object;
}

class CsvFixWriter : public FixWriter {
 public:
  CsvFixWriter(std::ostream& out, results::DecimalMark mark) : csv_(out, mark) {
    for (const char* name : {"epoch", "method", "status", "note", "x_m", "y_m", "z_m", "iterations", "objects", "gdop",
                             "residual_rms_m", "sigma_m"})
      csv_.text(name);
    for (const char* name : covariance_names) csv_.text(name);
    csv_.text("residuals_m");
    csv_.end_line();
  }

  void write(const Epoch& epoch, const EpochGeometry& geometry, const std::string& method, const Fix& fix) override {
    csv_.text(epoch.label);
    csv_.text(method);
    csv_.text(fix.status);
    csv_.text(note_of(geometry, fix));
    for (std::size_t axis = 0; axis < 3; ++axis)
      number_or_nothing(fix.position ? std::optional((*fix.position)[axis]) : std::nullopt);
    number_or_nothing(fix.position ? std::optional(fix.iterations) : std::nullopt);
    csv_.number(std::uint64_t{geometry.distinct});
    number_or_nothing(fix.uncertainty.gdop > 0.0 ? std::optional(fix.uncertainty.gdop) : std::nullopt);
    number_or_nothing(fix.position ? std::optional(fix.residual_rms_m) : std::nullopt);
    number_or_nothing(fix.uncertainty.sigma_m);
    for (std::size_t i = 0; i < covariance_names.size(); ++i)
      number_or_nothing(fix.uncertainty.covariance ? std::optional((*fix.uncertainty.covariance)[i]) : std::nullopt);
    std::string residuals;
    for (std::size_t j = 0; j < fix.residuals_m.size(); ++j)
      residuals += fmt::format("{}{}={}", j == 0 ? "" : " ", name_of_reading(epoch, j), fix.residuals_m[j]);
    csv_.text(residuals);
    csv_.end_line();
  }

  void flush() override { csv_.flush(); }

 private:
  void number_or_nothing(std::optional<double> value) {
    if (value) {
      csv_.number(*value);
    } else {
      csv_.text("");
    }
  }

  results::CsvWriter csv_;
};

class JsonFixWriter : public FixWriter {
 public:
  explicit JsonFixWriter(std::ostream& out) : out_(out) {}

  void write(const Epoch& epoch, const EpochGeometry& geometry, const std::string& method, const Fix& fix) override {
    using results::json_number;
    using results::json_string;
    const auto optional_number = [](const std::optional<double>& value) {
      return value ? json_number(*value) : std::string("null");
    };
    std::string line = fmt::format("{{\"epoch\":{},\"method\":{},\"status\":{},\"note\":{},", json_string(epoch.label),
                                   json_string(method), json_string(fix.status), json_string(note_of(geometry, fix)));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      line += fmt::format("\"{}_m\":{},", "xyz"[axis],
                          fix.position ? json_number((*fix.position)[axis]) : std::string("null"));
    }
    const std::string rms = fix.position ? json_number(fix.residual_rms_m) : "null";
    line += fmt::format("\"iterations\":{},\"objects\":{},\"gdop\":{},\"residual_rms_m\":{},\"sigma_m\":{},",
                        fix.position ? json_number(fix.iterations) : "null", geometry.distinct,
                        fix.uncertainty.gdop > 0.0 ? json_number(fix.uncertainty.gdop) : "null", rms,
                        optional_number(fix.uncertainty.sigma_m));
    for (std::size_t i = 0; i < covariance_names.size(); ++i) {
      line += fmt::format("\"{}\":{},", covariance_names[i],
                          fix.uncertainty.covariance ? json_number((*fix.uncertainty.covariance)[i]) : "null");
    }
    line += "\"residuals\":[";
    for (std::size_t j = 0; j < fix.residuals_m.size(); ++j) {
      line += fmt::format("{}{{\"object\":{},\"residual_m\":{}}}", j == 0 ? "" : ",",
                          json_string(name_of_reading(epoch, j)), json_number(fix.residuals_m[j]));
    }
    out_ << line << "]}\n";
  }

  void flush() override {
    if (!out_.flush()) throw core::IoError("cannot write the output: is the disk full or the reader gone?");
  }

 private:
  std::ostream& out_;
};

}  // namespace

std::unique_ptr<FixWriter> csv_fix_writer(std::ostream& out, results::DecimalMark mark) {
  return std::make_unique<CsvFixWriter>(out, mark);
}

std::unique_ptr<FixWriter> json_fix_writer(std::ostream& out) {
  return std::make_unique<JsonFixWriter>(out);
}

}  // namespace ridgeloc::studies
