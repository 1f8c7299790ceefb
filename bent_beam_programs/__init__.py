"""The programs that sit on the library: thesis, report, predictor and open benchmark."""
