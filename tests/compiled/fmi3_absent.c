/* Functions of FMI 3.0 that must be there but that no model here has a use for: fmi3Error.

The headers are left out on purpose, so that one line does for every signature. */

#define ABSENT(name) __attribute__((visibility("default"))) int name(void) { return 3; }

ABSENT(fmi3EnterEventMode) ABSENT(fmi3EnterStepMode)
ABSENT(fmi3EnterConfigurationMode) ABSENT(fmi3ExitConfigurationMode)
ABSENT(fmi3GetString) ABSENT(fmi3SetString) ABSENT(fmi3GetBinary) ABSENT(fmi3SetBinary)
ABSENT(fmi3GetClock) ABSENT(fmi3SetClock)
ABSENT(fmi3GetNumberOfVariableDependencies) ABSENT(fmi3GetVariableDependencies)
ABSENT(fmi3GetAdjointDerivative) ABSENT(fmi3GetOutputDerivatives)
ABSENT(fmi3GetIntervalDecimal) ABSENT(fmi3GetIntervalFraction)
ABSENT(fmi3GetShiftDecimal) ABSENT(fmi3GetShiftFraction)
ABSENT(fmi3SetIntervalDecimal) ABSENT(fmi3SetIntervalFraction)
ABSENT(fmi3SetShiftDecimal) ABSENT(fmi3SetShiftFraction)
ABSENT(fmi3EvaluateDiscreteStates) ABSENT(fmi3UpdateDiscreteStates)
ABSENT(fmi3EnterContinuousTimeMode) ABSENT(fmi3CompletedIntegratorStep) ABSENT(fmi3SetTime)
ABSENT(fmi3SetContinuousStates) ABSENT(fmi3GetContinuousStates)
ABSENT(fmi3GetContinuousStateDerivatives) ABSENT(fmi3GetNominalsOfContinuousStates)
ABSENT(fmi3GetNumberOfContinuousStates) ABSENT(fmi3GetNumberOfEventIndicators)
ABSENT(fmi3GetEventIndicators) ABSENT(fmi3ActivateModelPartition)
