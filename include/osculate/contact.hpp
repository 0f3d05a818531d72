#pragma once
/// Everything of Osculate::contact: contact of surfaces for other codes. Start with
/// `osculate/evaluator.hpp`; a whole host is examples/embedding/host.cpp.
#include "osculate/automatic_penalty.hpp"
#include "osculate/closest_points.hpp"
#include "osculate/csr.hpp"
#include "osculate/derivative_check.hpp"
#include "osculate/errors.hpp"
#include "osculate/evaluator.hpp"
#include "osculate/line_search.hpp"
#include "osculate/pattern.hpp"
#include "osculate/version.hpp"
