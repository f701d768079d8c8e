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
  std::string levels = "4 2 1";
  NdtOptions cells;  // but for their size

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.levels, Field{"levels", "m", "edges of the NDT cells of both clouds, coarse ones first"});
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

/** Throws ConfigError if [register] levels is not what it must be. */
std::vector<double> levelsOf(const RegisterSettings&, const Configuration&);

/** The cells of both clouds, made once for any number of guesses. */
class CloudPair
{
 public:
  using Points = std::vector<Eigen::Vector3f>;

  CloudPair(const Points& target, const Points& source, const std::vector<double>& levels, const RegisterSettings&);

  TimedRegistration registered(const Rigid& guess) const;

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
