@echo off
rem What ./learn is on Windows, for cmd and PowerShell. The work is done by learn.ps1.
powershell -NoProfile -ExecutionPolicy Bypass -File "%~dp0learn.ps1" %*
exit /b %ERRORLEVEL%
