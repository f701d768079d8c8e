/** Registration of two clouds on several levels of NDT cells, coarse to fine. */
#pragma once
#include "base/config/Configuration.h"
#include "estimation/ndt/Registration.h"
#include "lab/evaluation/internal/RegistrationTrials.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct RegisterOptions
{
  std::string levels = "8 4 2 0.5";
  std::string source_levels = "8 4 2 1";  // larger than the target's, as in the paper (2.5 m to 1 m): less noisy means
  NdtOptions cells;                       // without cell_size, which the levels give

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.levels, Field{"levels", "m", "edge lengths of the target's NDT cells, from coarse to fine"});
    visit(o.source_levels, Field{"source_levels", "m", "edge lengths of the source's cells, as many as levels"});
    NdtOptions::fields(o.cells,
                       [&](auto& member, const Field& field)
                       {
                         if (field.name != "cell_size") visit(member, field);
                       });
  }
};

struct RegisterSettings
{
  RegisterOptions clouds;
  RegistrationOptions alignment;

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.clouds, Section{"register", "NDT cells of the two clouds of 'register'"});
    visit(s.alignment, Section{"register_alignment", "their registration, started at --guess"});
  }
};

struct LevelSizes
{
  std::vector<double> target, source;  // m, of equal size
};

/** Throws ConfigError if [register] levels or source_levels are no falling lengths, or not of equal number. */
LevelSizes levelsOf(const RegisterSettings&, const Configuration&);

/** Makes the cells of both clouds once, for any number of guesses. */
class CloudPair
{
 public:
  using Points = std::vector<Eigen::Vector3f>;

  CloudPair(const Points& target, const Points& source, const LevelSizes&, const RegisterSettings&);

  TimedRegistration registered(const PoseGuess&) const;

  /**
   * How far away another pose is that may be the true one; none within half a metre and 5 deg, and none where 99 % of
   * the source meet the target. It is that of the target in the source from the same guess, where less than half meets;
   * or one found from the guess turned by 90, 180 or 270 deg, because walls of a room meet four ways: one that agrees
   * better, or, where less than 90 % meet, nearly as well.
   */
  std::optional<PoseError> contradiction(const RegistrationResult&, const Rigid& guess) const;

  double targetMilliseconds() const { return target_.milliseconds; }  // to make the cells
  double sourceMilliseconds() const { return source_.milliseconds; }

 private:
  std::optional<PoseError> rivalAtAnotherHeading(const RegistrationResult&, const Rigid& guess) const;

  struct Prepared
  {
    std::vector<NdtMap> levels;
    double milliseconds;
  };
  static Prepared prepare(const Points&, const std::vector<double>& levels, const NdtOptions&);

  Prepared target_, source_;
  RegistrationOptions options_;
};
}  // namespace scanloom
