"""Front ends: what cleans the measured wrench at the sensor's rate, one file each."""
