#include "case.hpp"

#include <cmath>

namespace osculate::verification {

double deviation(const Row& row) {
  const double difference = row.computed - row.reference;
  return row.reference != 0 ? difference / std::abs(row.reference) : difference;
}

bool passes(const Row& row) {
  switch (row.relation) {
    case Relation::equal:
      return std::abs(deviation(row)) <= row.tolerance;
    case Relation::at_most:
      return row.computed <= row.reference;
    case Relation::at_least:
      return row.computed >= row.reference;
    case Relation::info:
      return true;
  }
  return false;
}

std::string_view relation_text(Relation relation) {
  switch (relation) {
    case Relation::equal:
      return "==";
    case Relation::at_most:
      return "<=";
    case Relation::at_least:
      return ">=";
    case Relation::info:
      return "info";
  }
  return "?";
}

}  // namespace osculate::verification
