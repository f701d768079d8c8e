/**
 * All numbers of the estimator that were fitted to drives, or chosen on them, in one table. Other numbers of `ndt` and
 * `slam` follow from geometry, arithmetic or a processor, and stand where they are used.
 *
 * The last column is the section of doc/study/localisation.md that shows these drives and, where it was measured, what
 * other values do. "Drives" are simulated ones of dense, sparse and hard stands, and those of a second generator, with
 * one and two lidars.
 */
#pragma once
#include <cstddef>

namespace scanloom::fitted
{
// clang-format off
// name                               value       unit   fitted on                                         section

// What a lidar sees of stems (StemAxisCorrection)
constexpr double kStemSlimness        = 2;       // 1      length over width; drives, halved and doubled     #on-two-generators
constexpr double kStemRadius          = 0.3;     // m      the largest; drives, halved and doubled           #on-two-generators
constexpr double kStemAcrossSight     = 0.3;     // 1      least part of the view across the axis; drives    #on-two-generators
constexpr double kStemUprightness     = 0.8;     // 1      least upward part of a stem's axis; drives        #on-two-generators
constexpr double kStemRange           = 12;      // m      two columns hit a stem of 20 cm; drives           #on-two-generators
constexpr double kRangeNoise          = 0.04;    // m      deviation, of weak returns; drives                #on-two-generators
constexpr double kDepthSlope          = 1.6;     // 1      discs of even leaves, integrated; drives          #on-two-generators
constexpr double kAssumedDepth        = 0.03;    // m      of stems with few points; five seeds              #how-deep-a-lidar-sees
constexpr double kAssumedStems        = 10;      // 1      that count with this depth; five seeds            #how-deep-a-lidar-sees

// What it sees of foliage (RangeDensityBias)
constexpr double kExtinction          = 0.6;     // 1/m    along a ray; young spruce and undergrowth         #harder-worlds
constexpr double kDensityShare        = 0.5;     // 1      of the shift; hard worlds, one lidar              #how-deep-a-lidar-sees

// Cells and pairs of cells
constexpr double kSpreadOfFewPoints   = 0.08;    // m      deviation; dense stand, 16 beams                  #cells-of-few-points
constexpr double kFlatness            = 0.2;     // 1      deviation over the next larger; field, stairs     #beyond-the-forest
constexpr double kMixture             = 4;       // 1      at d2 = 1; five seeds of hard and dense           #mixtures

// Covariance of a registration (LidarInformation)
constexpr double kIndependentPoints   = 10;      // 1      the most in a cell, which share beams and edges   #on-two-generators
constexpr double kUnmodelled          = 1.25;    // 1      on the variance; mean NEES of pairs of two stands #on-two-generators
constexpr double kTranslationFloor    = 0.0008;  // m      mean errors of ranges, which no scan shows        #on-two-generators
constexpr double kRotationFloorDeg    = 0.004;   // deg    mean errors of beam angles, likewise              #on-two-generators
constexpr double kPlaceSize           = 6;       // m      within which cells err alike: leaves, ground      #on-two-generators
constexpr double kLeastCurvature      = 0.05;    // 1      of Gauss-Newton; saddles 0, real streets 0.07     #saddles
constexpr double kDegenerate          = 0.1;     // 1      share of structure; corridors, dense stands       #on-two-generators
constexpr double kDoubtful            = 0.35;    // 1      the same, if a long step changes nothing          #on-two-generators
constexpr double kUnchangedScore      = 0.9;     // 1      corridors keep 0.92, the densest stand 0.86       #on-two-generators

// Search of the minimum (Minimiser, Registration, AmbiguousPoses)
constexpr double kScoreSlack          = 0.02;    // 1      rise of the score that a step may cost; drives    #on-two-generators
constexpr double kParallelSteps       = 0.8;     // 1      cosine; drives                                    #on-two-generators
constexpr double kMostShrinking       = 0.7;     // 1      of a step over the one before; drives             #on-two-generators
constexpr double kReachOfCells        = 0.3;     // 1      of a cell's size: how far off a guess may be      #on-two-generators
constexpr double kStillNear           = 0.15;    // 1      of a cell's size: common cells stay the same      #on-two-generators
constexpr double kBroadD2             = 0.05;    // 1      d2 whose maxima are as wide as a step of a grid   #on-two-generators
constexpr double kHeadingStandsOut    = 1.04;    // 1      over the median; bare ground 1.03, dense 1.06     #on-two-generators
constexpr double kRivalCandidate      = 0.5;     // 1      of the best broad score; stems in rows            #on-two-generators

// Registration of a scan, and of a lost body (ScanRegistration, Relocalisation)
constexpr double kUsualDistance       = 5;       // 1      deviations; 28 drives                             #large-cells-that-mislead
constexpr double kScoreOfAgreement    = 0.9;     // 1      of the usual score; 28 drives                     #large-cells-that-mislead
constexpr double kScoreOfRival        = 0.8;     // 1      of the best score; drives made to get lost        #made-to-get-lost
constexpr double kScoreOfPlace        = 0.75;    // 1      of the last trusted score; the same               #made-to-get-lost
constexpr double kOverlapOfPlace      = 0.5;     // 1      the same                                          #made-to-get-lost
constexpr double kDeviationOfPlace    = 0.3;     // m      the same                                          #made-to-get-lost
constexpr double kStartsApart         = 3;       // m      alignment finds a pose within 2 m of its start    #on-two-generators
constexpr double kWorkingImuDeg       = 3;       // deg    tilt of an IMU that works                         #made-to-get-lost
constexpr double kMachineSpeed        = 1.5;     // m/s    the most that a lost harvester drives             #made-to-get-lost
constexpr double kSpeedAtRest         = 1;       // m/s    deviation of a lost body taken to be at rest      #both-lidars-silent

// A drive in the map of an earlier one (PlaceSearch)
constexpr double kAgreementOfPlace    = 0.7;     // 1      of the score with itself; other stands, rows      #in-a-map
constexpr double kReachOfMap          = 6;       // m      how far from its keyframes a map is searched      #in-a-map
constexpr double kLeanOfStartDeg      = 12;      // deg    of a machine on the ground, without an IMU        #in-a-map
constexpr std::size_t kKeyframesTogether = 3;    // 1      what a machine sees on about 10 m                 #in-a-map
constexpr std::size_t kPlacesAligned = 6;        // 1      of the best scores; the same stands               #in-a-map
constexpr std::size_t kCellsToScreen = 500;      // 1      of some thousand: a tenth of the time             #in-a-map
constexpr double kSightInMap          = 25;      // m      keyframes farther away share few cells            #in-a-map
constexpr double kWayInMap            = 2;       // m      until others of its keyframes may be nearer       #in-a-map
constexpr double kSamePlace           = 0.25;    // m      between two keyframes' places; the same           #in-a-map
constexpr double kSamePlaceDeg        = 1;       // deg    the same                                          #in-a-map

// Noise that registrations share (SharedAttitudeNoise, MeasurementCorrelation, Tracker)
constexpr double kSharedTiltDeg       = 0.03;    // deg    drives of 120 to 315 m                            #harder-worlds
constexpr double kSightLength         = 12;      // m      drives of 120 to 315 m                            #harder-worlds
constexpr double kPlaceRadius         = 0.05;    // m      foliage scatters by 1 to 2 cm                     #where-the-machine-stands
constexpr double kLeastTravel         = 0.02;    // m      at rest; drives with stops                        #where-the-machine-stands
constexpr double kCorrelationLength   = 2;       // m      registrations within it err alike; drives         #where-the-machine-stands
constexpr double kScaleError          = 6e-4;    // 1      of the way; NEES since the start                  #consistency

// Estimate against registration (DivergenceDetector): good ones reach 0.21 m and 13 deviations
constexpr double kApart               = 0.1;     // m      good drives with one lidar                        #on-two-generators
constexpr double kApartRadians        = 0.02;    // rad    good drives with one lidar                        #on-two-generators
constexpr double kApartDeviations     = 8;       // 1      good drives with one lidar                        #on-two-generators
constexpr double kFarApart            = 0.25;    // m      good drives with one lidar                        #on-two-generators
constexpr double kFarApartRadians     = 0.05;    // rad    good drives with one lidar                        #on-two-generators
constexpr double kFarApartDeviations  = 15;      // 1      good drives with one lidar                        #on-two-generators
constexpr double kGate                = 40;      // 1      deviations off the IMU that are still trusted     #imu-faults

// Whether the lidar's track goes on (LidarTrack): 3 m/s too much smear a scan by 0.3 m
constexpr double kSameStep            = 0.5;     // m      pushes of 5 to 30 m/s2 for 0.2 s                  #imu-faults
constexpr double kSameStepRadians     = 0.1;     // rad    the same                                          #imu-faults

// A map that is levelled anew (StateEstimate::mapJumped)
constexpr double kMapJump             = 0.25;    // m      sound drives 0.08, maps tilted by cars 1 and more #real-sequences

// Keyframes of the local map, and the first velocity of a drive without an IMU (LocalMap, StartUp)
constexpr double kKeyframeTurnDeg     = 20;      // deg    turn after which a scan joins the map; drives     #keyframes
constexpr std::size_t kTrialScans = 4;           // 1      enough for a velocity, still that of the first    #starts

// Another IMU takes over (SmootherReset): deviations
constexpr double kTiltOfChange        = 0.005;   // rad    runs in which an IMU fails                        #imu-faults
constexpr double kVelocityOfChange    = 0.3;     // m/s    the same                                          #imu-faults
constexpr double kGyroBiasUnknown     = 0.02;    // rad/s  the same                                          #imu-faults
constexpr double kGyroBiasKnown       = 0.001;   // rad/s  the same                                          #imu-faults
constexpr double kAccelBiasKnown      = 0.02;    // m/s2   by the lever's accelerations                      #imu-faults
// clang-format on
}  // namespace scanloom::fitted
