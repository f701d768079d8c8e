/** Two clouds made ready for registration: the one place where the program meets libs/ndt. */
#pragma once
#include "config/Configuration.h"
#include "evaluation/RegistrationTrials.h"
#include "ndt/Registration.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace scanloom
{
struct RegisterOptions
{
  std::string levels = "8 4 2 0.5";
  std::string source_levels = "8 4 2 1";  // like the paper's 2.5 m to 1 m: means of larger cells are less noisy
  NdtOptions cells;                       // but for their size

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.levels, Field{"levels", "m", "edges of the target's NDT cells, coarse ones first"});
    visit(o.source_levels, Field{"source_levels", "m", "of the source's cells: as many"});
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
    visit(s.clouds, Section{"register", "NDT cells of two clouds that are registered with each other"});
    visit(s.alignment, Section{"register_alignment", "their alignment, from the guess on"});
  }
};

struct LevelSizes
{
  std::vector<double> target, source;  // m, as many
};

/** Throws ConfigError if [register] levels or source_levels are not what they must be. */
LevelSizes levelsOf(const RegisterSettings&, const Configuration&);

/** The cells of both clouds, made once for any number of guesses. */
class CloudPair
{
 public:
  using Points = std::vector<Eigen::Vector3f>;

  CloudPair(const Points& target, const Points& source, const LevelSizes&, const RegisterSettings&);

  TimedRegistration registered(const PoseGuess&) const;

  double targetMilliseconds() const { return target_.milliseconds; }  // of preparation
  double sourceMilliseconds() const { return source_.milliseconds; }

 private:
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
