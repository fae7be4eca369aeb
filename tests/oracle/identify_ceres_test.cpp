// The online estimate of (k, λ, n) against a batch maximum likelihood fit by Ceres Solver of the same
// records, and against the Cramér-Rao bound. Cells: k 1e2..1e7, n 1, 1.5, 2, three noises, three excitations;
// what counts in a cell is identifiable there: a bound of at most 5 % (k), 0.05 (n), 20 % (λ).

#include <gtest/gtest.h>

#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/contact/contact_batch.hpp"
#include "deploy/lab/contact/contact_record.hpp"
#include "slave/estimation/identifier.hpp"

namespace longreach::identify_ceres_test {
namespace {

using test::ContactBound;
using test::ContactCell;
using test::Samples;

struct Errors {
  double k = 0.0, lambda = 0.0, n = 0.0;  // of k and λ as fractions
};

ContactAnswer online(const Samples& record) {
  Identifier identifier({});  // the noise is learnt from the samples
  for (const PenetrationSample& s : record) identifier.step(s, 1e-3);
  return identifier.answer();
}

Errors errors(const ContactCell& cell, const ContactAnswer& a) {
  return {a.k.value / cell.k - 1.0, a.lambda.value / cell.lambda() - 1.0, a.n.value - cell.n};
}

Errors errors(const ContactCell& cell, const test::ContactBatch& b) {
  return {b.k / cell.k - 1.0, b.lambda / cell.lambda() - 1.0, b.n - cell.n};
}

void add_squares(Errors& sum, const Errors& e) {
  sum.k += e.k * e.k;
  sum.lambda += e.lambda * e.lambda;
  sum.n += e.n * e.n;
}

std::string text(const ContactCell& c) {
  return "k " + std::to_string(c.k) + " n " + std::to_string(c.n) + " noise " + std::to_string(c.noise_n) +
         " excitation " + std::to_string(static_cast<int>(c.excitation));
}

std::vector<ContactCell> cells() {
  std::vector<ContactCell> all;
  for (int decade = 2; decade <= 7; ++decade)
    for (const double n : {1.0, 1.5, 2.0})
      for (const double noise : {0.01, 0.05, 0.25})
        for (int excitation = 0; excitation < 3; ++excitation)
          all.push_back({std::pow(10.0, decade), n, 0.15, noise, static_cast<test::Excitation>(excitation)});
  return all;
}

struct Parameter {
  const char* name;
  double Errors::*error;
  double ContactBound::*bound;
  double limit;  // of the bound: identifiable
  Identified ContactAnswer::*answer;
};
constexpr Parameter kParameters[] = {
    {"k", &Errors::k, &ContactBound::k, 0.05, &ContactAnswer::k},
    {"lambda", &Errors::lambda, &ContactBound::lambda, 0.2, &ContactAnswer::lambda},
    {"n", &Errors::n, &ContactBound::n, 0.05, &ContactAnswer::n}};

TEST(Identification, IsAsGoodAsABatchFitOfTheSameRecords) {
  const int records = campaign(500, 4);
  Errors worst;
  for (const ContactCell& cell : cells()) {
    const Samples exact = test::exact_record(cell);
    const ContactBound bound = test::cramer_rao(cell, exact);
    Random random = Random(1).child(text(cell));
    Errors of_online, of_batch;
    for (int i = 0; i < records; ++i) {
      const Samples record = test::with_noise(exact, cell.noise_n, random);
      add_squares(of_online, errors(cell, online(record)));
      add_squares(of_batch, errors(cell, test::batch_fit(cell, record)));
    }
    for (const Parameter& p : kParameters) {
      if (bound.*p.bound > p.limit) continue;
      // With few records the batch fit may by chance be better than its own bound.
      const double least = campaign(0, 1) * std::pow(bound.*p.bound, 2) * records;
      const double ratio = std::sqrt(of_online.*p.error / std::max(of_batch.*p.error, least));
      worst.*p.error = std::max(worst.*p.error, ratio);
      EXPECT_LE(ratio, 1.05) << p.name << ", " << text(cell);
    }
  }
  std::printf("worst ratio to the batch fit over %d records a cell: k %.3f, lambda %.3f, n %.3f\n", records,
              worst.k, worst.lambda, worst.n);
}

TEST(Identification, ReachesTheCramerRaoBoundAndSaysWhereItTellsNothing) {
  const int records = campaign(2000, 10);
  Errors worst, pooled, counted;
  for (const ContactCell& cell : cells()) {
    const Samples exact = test::exact_record(cell);
    const ContactBound bound = test::cramer_rao(cell, exact);
    Random random = Random(2).child(text(cell));
    Errors sum;
    int said[3] = {0, 0, 0};
    for (int i = 0; i < records; ++i) {
      const ContactAnswer answer = online(test::with_noise(exact, cell.noise_n, random));
      add_squares(sum, errors(cell, answer));
      for (int p = 0; p < 3; ++p) said[p] += (answer.*kParameters[p].answer).verdict == Verdict::kIdentified;
    }
    for (int i = 0; i < 3; ++i) {
      const Parameter& p = kParameters[i];
      // The verdict knows λ itself only as it is estimated: a fifth of room on either side.
      if (bound.*p.bound > 1.2 * p.limit && bound.*p.bound < 3.0) {
        EXPECT_LT(said[i], 0.2 * records + 1) << p.name << ", " << text(cell);
      }
      if (bound.*p.bound < 0.7 * p.limit) {
        EXPECT_GE(said[i], 0.95 * records - 1) << p.name << ", " << text(cell);
      }
      if (bound.*p.bound > p.limit) continue;
      const double square = sum.*p.error / (records * std::pow(bound.*p.bound, 2));
      worst.*p.error = std::max(worst.*p.error, std::sqrt(square));
      pooled.*p.error += square;
      counted.*p.error += 1.0;
      if (campaign(1, 0) == 1) {
        EXPECT_LE(std::sqrt(square), 1.10) << p.name << ", " << text(cell);
      }
    }
  }
  for (const Parameter& p : kParameters)
    EXPECT_LE(std::sqrt(pooled.*p.error / counted.*p.error), 1.05) << p.name;
  std::printf(
      "over the bound, all cells: k %.3f, lambda %.3f, n %.3f; worst of a cell of %d records: k %.3f, lambda "
      "%.3f, n %.3f\n",
      std::sqrt(pooled.k / counted.k), std::sqrt(pooled.lambda / counted.lambda),
      std::sqrt(pooled.n / counted.n), records, worst.k, worst.lambda, worst.n);
}

}  // namespace
}  // namespace longreach::identify_ceres_test
