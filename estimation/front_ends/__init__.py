"""What is made of the wrench at the sensor's rate, one file each."""
