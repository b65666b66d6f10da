#include "studies/study/setting_builders.hpp"

namespace ridgeloc::studies {

Setting Section::number(Kind kind, std::string name, Value standard, Interval bounds, std::string unit,
                        std::string description) const {
  Setting setting = other(kind, std::move(name), std::move(standard), std::move(description));
  setting.low = bounds[0];
  setting.high = bounds[1];
  setting.unit = std::move(unit);
  return setting;
}

Setting Section::other(Kind kind, std::string name, Value standard, std::string description) const {
  Setting setting;
  setting.section = name_;
  setting.name = std::move(name);
  setting.kind = kind;
  setting.standard = std::move(standard);
  setting.description = std::move(description);
  return setting;
}

Setting Section::real(std::string name, double standard, Interval bounds, std::string unit,
                      std::string description) const {
  return number(Kind::Real, std::move(name), standard, bounds, std::move(unit), std::move(description));
}

Setting Section::range(std::string name, Interval standard, Interval bounds, std::string unit,
                       std::string description) const {
  return number(Kind::Range, std::move(name), standard, bounds, std::move(unit), std::move(description));
}

Setting Section::samples(std::string name, Interval bounds, std::string description) const {
  return number(Kind::Samples, std::move(name), Samples(), bounds, "1", std::move(description));
}

Setting Section::positions(std::string name, Interval bounds, std::string description) const {
  return number(Kind::Positions, std::move(name), Positions(), bounds, "m", std::move(description));
}

Setting Section::choice(std::string name, std::vector<std::string> choices, std::string standard,
                        std::string description) const {
  Setting setting = other(Kind::Choice, std::move(name), std::move(standard), std::move(description));
  setting.choices = std::move(choices);
  return setting;
}

Setting Section::text(std::string name, std::string standard, std::string description) const {
  return other(Kind::Text, std::move(name), std::move(standard), std::move(description));
}

Setting Section::building(std::string name, Building standard, std::string description) const {
  return other(Kind::Building, std::move(name), std::move(standard), std::move(description));
}

Setting per_method(Setting setting) {
  setting.per_method = true;
  return setting;
}

Setting read_if(Condition condition, Setting setting) {
  setting.read_if = std::move(condition);
  return setting;
}

}  // namespace ridgeloc::studies
