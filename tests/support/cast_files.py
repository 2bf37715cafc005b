# SPDX-License-Identifier: BSD-3-Clause
"""Measured casts of vendors (shared/data/svp), and small ones of each format to break."""

from __future__ import annotations

from pathlib import Path

import pytest

SVP = Path(__file__).resolve().parents[3] / "shared" / "data" / "svp"

# File → rows in it, deepest row [m], and what it measures besides depth.
MEASURED = {
    "aml_025485_2019-04-11_18-25-00.csv": (19, 9.21, "cp"),
    "aml_aml_log_2021-06-16_17-23-45.aml": (842, 0.08, "tscp"),
    "aml_aml_log_2024-04-07_20-39-17.aml": (90, 0.172, "tscp"),
    "asvp_20120321_224205.asvp": (35, 12000.0, "c"),
    "castaway_11E101663_20120821_122817.csv": (75, 22.4, "tscp"),
    "castaway_11E101663_20120821_145912.csv": (76, 22.6, "tscp"),
    "castaway__10M100491_20120222_070924_cast_away.csv": (80, 23.8, "tscp"),
    "hypack_20190819_SV_1549_D.vel": (36, 54.2, "c"),
    "hypack_20190819_SV_1856_D.vel": (33, 45.5, "c"),
    "hypack_20190819_SV_2035_D.vel": (33, 46.3, "c"),
    "oceanscience_PS118_3-1_down.asc": (2388, 578.3, "tsp"),
    "seabird_SBE19Plus_CTP_2013_066_200153.cnv": (653, 3.8, "tsp"),
    "seabird__tan1802_094_ctd_converted.cnv": (705, 800.3, "tscp"),
    "sippican_T5_00002_oldsippicansoft.EDF": (3202, 2000.0, "tsc"),
    "sippican_T7_00007.EDF": (1580, 1000.0, "tsc"),
    "valeport_midas_svp_MIDAS_SVP_sample.vpd": (1568, 35.0, "tscp"),
}


def measured(name: str) -> Path:
    """A file of the shared data; the test is skipped where it is not here."""
    path = SVP / name
    if not path.is_file():
        pytest.skip(f"{name} of the shared data is not here")
    return path


CASTAWAY = """\
% Device,12A
% Cast time (UTC),2020-02-03 04:05:06
% Start latitude,50.5
% Start longitude,-3.25
%\x20
Pressure (Decibar),Depth (Meter),Temperature (Celsius),Salinity (Practical Salinity Scale),\
Sound velocity (Meters per Second)
1,0.99,12.0,35.0,1498.0
2,1.98,11.9,35.0,1497.7
"""
AML = """\
[Header]
Date=2021-06-16
Time=17:23:45
Model=AML-3
Latitude=0.0
Longitude=0.0
[MeasurementMetadata]
Columns=Date,Time,Battery,Cond,TempCT,SV,Pressure
Units=yyyy-mm-dd,hh:mm:ss.ss,V,mS/cm,C,m/s,dbar
[MeasurementData]
2021-06-16,17:23:45.65,7.8,42.914,15.0,0.000,0.0
2021-06-16,17:23:46.65,7.8,42.914,15.0,1506.7,10.0
"""
AML_CSV = """\
[cast header]\r\r
Type=Base.X2\r\r
SN=1\r\r
DisplayBattery=yes\r\r
Latitude=43.5\r\r
Longitude=-70.5\r\r
[Slot 1]\r\r
SensorName=SV-C-CT.Xchange SV.X SN 2 01/14/19\r\r
[Slot 3]\r\r
SensorName=P-T-TU-DO-UV.Xchange P.X SN 3 01/15/19\r\r
[data]\r\r
2019-04-11,18:25:01.36,1451.274,0000.09,007.60\r\r
2019-04-11,18:25:05.04,1457.401,0001.09,007.60\r\r
"""
SEABIRD = """\
* Sea-Bird SBE19Plus Data File:
* NMEA Latitude = 43 30.0 N
* NMEA Longitude = 070 30.0 W
# nvalues = 2
# name 0 = prdM: Pressure, Strain Gauge [db]
# name 1 = t090C: Temperature [ITS-90, deg C]
# name 2 = sal00: Salinity, Practical [PSU]
# start_time = Mar 07 2013 15:09:24 [System UpLoad Time]
# bad_flag = -9.990e-29
*END*
      0.029     9.3652    31.5
      1.029     9.3640  -9.990e-29
"""
HYPACK = "FTP NEW 3 37.9 -122.4 15:47 08/19/2019\n0.0 1504.92\n1.2 1504.90\n"
ASVP = (
    "( SoundVelocity  1.0 0 201203212242 22.5 -156.5 -1 0 0 OMS01 P 0002 )\n"
    "0.00 1531.4\n10.00 1530.1\n"
)
VALEPORT = """\
[Application]
Title=Valeport Datalog X2
[Header]
Instrument=MIDAS SVP
Latitude=
[Data]
Date/Time\tDepth\tSound Velocity\tPressure\tTemperature\tSalinity
\tm\tM/SEC\tDBAR\tC\tPSU
2021/12/24 18:57:14\t0.105\t0.000\t0.105\t16.849\t
2021/12/24 18:58:14\t1.105\t1501.2\t1.115\t13.849\t34.5
"""
SIPPICAN = """\
// This is a MK21 EXPORT DATA FILE  (EDF)
//
Date of Launch:  07/14/2017
Time of Launch:  16:40:45
Latitude      :  22 30.0N
Longitude     :  17 15.0W
Probe Type       :  T-5
// Sound velocity derived with assumed salinity: 37.20 ppt
//
Depth (m) - Temperature (M-0C) - Sound Velocity (m/s)
1.4\t20.97\t1526.57
2.0\t20.92\t1526.46
"""
OCEANSCIENCE = """\
*PS118_3-1
*Lat -63.420
*Lon -56.615
*Cast 3 21 Feb 2019 22:14:27 4800 4.14 normal end
*scan# C[S/m]  T[degC]  P[dbar]
1  2.79479 -0.764    1.187
2  2.79479 -0.759    1.437
"""
PLAIN = "depth [m],temperature (°C),salinity,sound_speed_m/s\n0,12,35,1498\n20,11,35,1495\n"

WRITTEN = {
    "castaway": CASTAWAY,
    "aml": AML,
    "aml_csv": AML_CSV,
    "seabird": SEABIRD,
    "hypack": HYPACK,
    "asvp": ASVP,
    "valeport": VALEPORT,
    "sippican": SIPPICAN,
    "oceanscience": OCEANSCIENCE,
    "plain": PLAIN,
}
