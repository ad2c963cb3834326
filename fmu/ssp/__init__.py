"""Systems of FMUs, as files of the SSP standard."""
